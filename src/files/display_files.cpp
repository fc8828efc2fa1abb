#include "petzval/display_files.h"

#include "petzval/files.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

namespace petzval {

Result<FileKind> kind_of_output(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".exr") return FileKind::Exr;
    if (extension == ".png") return FileKind::Png;
    return Error{ErrorCode::InvalidArgument,
                 path + ": the name must end in .exr or .png (standard output is -.exr or -.png)"};
}

DevelopSettings DisplayChoice::settings(int code_bits, std::optional<Transfer> transfer, int threads) const {
    return {.exposure_stops = exposure_stops.value_or(0),
            .contrast = contrast.value_or(1),
            .tone = tone.value_or(code_bits > 0 ? ToneCurve::None : ToneCurve::Filmic),
            .transfer = transfer.value_or(Transfer::Srgb),
            .bits = bits.value_or(code_bits == 16 ? 16 : 8),
            .threads = threads};
}

Status write_codes(const std::string& path, int width, int height, std::vector<std::uint16_t> codes, int bits,
                   bool overwrite, double pixel_aspect, PngTexts texts) {
    return write_png(path,
                     {.width = width,
                      .height = height,
                      .channels = 3,
                      .bits = bits,
                      .samples = std::move(codes),
                      .pixel_aspect = pixel_aspect,
                      .texts = std::move(texts)},
                     overwrite);
}

Status write_developed(const std::string& path, View<const Rgba> picture, const DevelopSettings& settings,
                       bool overwrite, double pixel_aspect, PngTexts texts) {
    return write_codes(path, picture.width(), picture.height(), develop(picture, settings), settings.bits,
                       overwrite, pixel_aspect, std::move(texts));
}

Status write_grey_png(const std::string& path, View<const float> plane, bool overwrite, PngTexts texts) {
    PngPixels grey{.width = plane.width(),
                   .height = plane.height(),
                   .channels = 1,
                   .bits = 16,
                   .samples = {},
                   .pixel_aspect = 1,
                   .texts = std::move(texts)};
    grey.samples.reserve(std::size_t(plane.width()) * std::size_t(plane.height()));
    for (int y = 0; y < plane.height(); ++y)
        for (int x = 0; x < plane.width(); ++x) {
            const float value = plane(x, y) > 0 ? std::min(plane(x, y), 1.0f) : 0.0f;
            grey.samples.push_back(std::uint16_t(std::lround(65535 * value)));
        }
    return write_png(path, grey, overwrite);
}

}  // namespace petzval
