// PNG inside this room: a picture read as a frame, and depth read from it.
#pragma once

#include "petzval/files.h"

#include "files/input_file.h"

#include <memory>

namespace petzval {

// As read_png(); read_png_size() leaves the samples empty.
Result<PngPixels> read_png_file(const InputFile& file, std::size_t max_pixels);
Result<PngPixels> read_png_size(const InputFile& file, std::size_t max_pixels);

// Decoded through the sRGB curve and premultiplied; display-referred. `pixels` false: size only.
Result<Frame> read_png_frame(const std::shared_ptr<const InputFile>& file, const ReadOptions& options,
                             bool pixels);

}  // namespace petzval
