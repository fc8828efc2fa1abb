// The pictures that a look names: what the aperture lets through, discs that stand for a lens.
#include "petzval/names.h"
#include "petzval/shot.h"

#include <utility>

namespace petzval {
namespace {

bool is_png(const std::string& path) {
    for (const char* ending : {".exr", ".EXR", ".jpg", ".JPG", ".jpeg", ".tif", ".TIF", ".tiff"})
        if (path.ends_with(ending)) return false;
    return true;
}

Result<Picture> read_picture(const std::string& path, int threads, Transfer transfer = Transfer::Srgb) {
    ReadOptions options;
    options.threads = threads;
    options.transfer = transfer;
    options.need_depth = false;
    auto frame = read_frame(path, options);
    if (!frame) return frame.error();
    return std::move(frame->colour);
}

// Transmission: a PNG as stored, 0 to white; of other files their luminance, whole numbers as stored.
Result<Plane> read_transmission(const std::string& path, int threads) {
    if (!is_png(path)) {
        const auto picture = read_picture(path, threads, Transfer::Linear);
        if (!picture) return picture.error();
        Plane plane(picture->width(), picture->height());
        for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = luminance(picture->pixels()[i]);
        return plane;
    }
    const auto png = read_png(path);
    if (!png) return png.error();
    Plane plane(png->width, png->height);
    const float white = png->bits == 16 ? 65535.0f : 255.0f;
    const auto channels = std::size_t(png->channels),
               colours = channels >= 3 ? std::size_t(3) : std::size_t(1);
    for (std::size_t i = 0; i < plane.size(); ++i) {
        float sum = 0;
        for (std::size_t c = 0; c < colours; ++c) sum += float(png->samples[i * channels + c]);
        plane.pixels()[i] = sum / (float(colours) * white);
    }
    return plane;
}

Error of_field(const char* field, const Error& error) {
    return {error.code, std::string(field) + ": " + error.message, field};
}

}  // namespace

Status read_lens_images(Look& look, int threads) {
    if (!look.aperture_image.empty()) {
        auto plane = read_transmission(look.aperture_image, threads);
        if (!plane) return of_field("lens.aperture_image", plane.error());
        look.lens.texture.image = std::make_shared<const Plane>(std::move(*plane));
    }
    for (const auto& [file, picture] : {std::pair{&look.kernel_image_far, &look.lens.kernel_images.far},
                                        {&look.kernel_image_near, &look.lens.kernel_images.near}}) {
        if (file->empty()) continue;
        auto read = read_picture(*file, threads);
        if (!read) return of_field("lens.kernel_images", read.error());
        *picture = std::make_shared<const Picture>(std::move(*read));
    }
    return Done{};
}

}  // namespace petzval
