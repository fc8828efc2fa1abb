// Writing a picture into all that its file held beside it.
#pragma once

#include "petzval/files.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <span>

#include <OpenEXR/ImfIO.h>

namespace petzval {

// Frames of one file, each with what it carries: more than one are views of it, each with its own colour.
// Errors: those of write_exr(). Throws what OpenEXR throws.
Status write_carried(Imf::OStream& stream, std::span<const Frame* const> frames, const WriteOptions& options,
                     Workers& workers);

}  // namespace petzval
