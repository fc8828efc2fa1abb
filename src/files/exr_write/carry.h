// Writing a picture into all that its file held beside it.
#pragma once

#include "petzval/files.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <span>

#include <OpenEXR/ImfIO.h>

namespace petzval {

// Writes frames of one file, each with its carried data: several frames are views with separate colours.
// Errors: those of write_exr(). Throws OpenEXR's exceptions.
Status write_carried(Imf::OStream& stream, std::span<const Frame* const> frames, const WriteOptions& options,
                     Workers& workers);

}  // namespace petzval
