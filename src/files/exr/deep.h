// Deep EXR parts: every sample, and the flat picture they look like from the front.
#pragma once

#include "petzval/deep.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include "files/channels/channel_choice.h"
#include "files/exr/file.h"

#include <cstddef>

namespace petzval {

// All samples, nearest first, depths as stored. Colours that are not finite are replaced and counted; a depth
// that is NaN becomes +infinity. Without ZBack a sample ends where it starts; without alpha it is opaque.
// Errors: InvalidFile, also for more samples than twice options.max_pixels or than a file of this size could
// hold; OutOfMemory: more than options.max_memory_bytes.
Result<DeepPicture> read_deep(const ExrFile& exr, const ColourChoice& colour, const DepthChoice& depth,
                              const ReadOptions& options, std::size_t& non_finite);

}  // namespace petzval
