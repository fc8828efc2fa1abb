// Motion vectors of an EXR.
#pragma once

#include "petzval/files.h"
#include "petzval/motion.h"
#include "petzval/result.h"

#include "files/channels/channel_choice.h"
#include "files/exr/file.h"

namespace petzval {

// Reads motion into frame.motion and the choice into frame.detected; nothing if it is not wanted or missing.
// Errors: those of choose_motion() and of reading; OutOfMemory beyond options.max_memory_bytes.
Status read_motion(const ExrFile& exr, const ColourChoice& colour, const ReadOptions& options, Frame& frame);

}  // namespace petzval
