// Reading a picture from an EXR file.
#pragma once

#include "petzval/files.h"

#include "files/input_file.h"

#include <memory>

namespace petzval {

// Implements read_frame() and read_frame_header() for EXR files. `pixels` false: header only. Only
// options.workers counts, and it is never null here; options.threads is ignored.
Result<Frame> read_exr_frame(const std::shared_ptr<const InputFile>& file, const ReadOptions& options,
                             bool pixels);

// frame.depth from options.depth_file, as read_depth_file() reads it. Adds lines to frame.detected.
Status take_depth_file(const ReadOptions& options, Frame& frame);

}  // namespace petzval
