// Reading a picture from an EXR file.
#pragma once

#include "petzval/files.h"

#include "files/input_file.h"

#include <memory>

namespace petzval {

// As read_frame() and read_frame_header() promise, for a file that starts like an EXR. `pixels` false: header
// only. Of options.threads and workers the latter alone are asked: never null from here on.
Result<Frame> read_exr_frame(const std::shared_ptr<const InputFile>& file, const ReadOptions& options,
                             bool pixels);

// frame.depth from another file, EXR or PNG of any size, in the colour's data window. Adds a line to
// frame.detected.
Status read_depth_file(const ReadOptions& options, Frame& frame);

}  // namespace petzval
