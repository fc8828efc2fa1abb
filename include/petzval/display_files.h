// Display pictures as PNG files, and the output format of a file name. Component
// petzval::files.
#pragma once

#include "petzval/develop.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace petzval {

enum class FileKind { Exr, Png };
// The format of the name's extension. Errors: InvalidArgument, which lists the accepted
// extensions.
PETZVAL_API Result<FileKind> kind_of_output(const std::string& path);

// The conversion of scene-linear light to a display picture. Fields that are not given get defaults that
// depend on the input: a picture of display codes keeps its look, and its 16 bits.
struct DisplayChoice {
    std::optional<double> exposure_stops = {}, contrast = {};
    std::optional<ToneCurve> tone = {};
    std::optional<int> bits = {};  // 8 or 16

    // code_bits: as Frame::code_bits.
    PETZVAL_API DevelopSettings settings(int code_bits, std::optional<Transfer> transfer, int threads) const;
};

// Key and text of each text chunk of a PNG.
using PngTexts = std::vector<std::pair<std::string, std::string>>;
// Codes of develop(). pixel_aspect: of the file's pixels, where they are not square. Errors: OutputFailed.
PETZVAL_API Status write_codes(const std::string& path, int width, int height,
                               std::vector<std::uint16_t> codes, int bits, bool overwrite,
                               double pixel_aspect = 1, PngTexts texts = {});
// The same from scene-linear light, by develop().
PETZVAL_API Status write_developed(const std::string& path, View<const Rgba> picture,
                                   const DevelopSettings& settings, bool overwrite, double pixel_aspect = 1,
                                   PngTexts texts = {});
// A plane as 16-bit grey: 0…1 becomes 0…65535; other values are clamped, NaN is 0.
PETZVAL_API Status write_grey_png(const std::string& path, View<const float> plane, bool overwrite,
                                  PngTexts texts = {});

}  // namespace petzval
