#include "kernel/lenses/image_lens.h"

#include "base/cancel.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

Plane channel(View<const Rgba> picture, float Rgba::*which) {
    Plane plane = Plane::uninitialised(picture.width(), picture.height());
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) plane(x, y) = picture(x, y).*which;
    return plane;
}

bool holds_light(const Picture& picture, float Rgba::*which) {
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (std::isfinite(picture.pixels()[i].*which) && picture.pixels()[i].*which > 0) return true;
    return false;
}

}  // namespace

Status check_kernel_images(const KernelImages& images) {
    if (!images.far)
        return Error{ErrorCode::InvalidArgument,
                     "lens.kernel_images: the picture for discs behind focus is missing"};
    for (const auto& picture : {images.far, images.near})
        for (const auto which : {&Rgba::r, &Rgba::g, &Rgba::b})
            if (picture && !holds_light(*picture, which))
                return Error{ErrorCode::InvalidArgument,
                             "lens.kernel_images must hold light in red, green and blue"};
    return Done{};
}

ImageLens::Channels::Channels(View<const Rgba> picture)
    : r(channel(picture, &Rgba::r)), g(channel(picture, &Rgba::g)), b(channel(picture, &Rgba::b)) {}

Rgba ImageLens::Channels::mean(Point middle, double half_width, double half_height) const {
    return {float(r.mean(middle, half_width, half_height)), float(g.mean(middle, half_width, half_height)),
            float(b.mean(middle, half_width, half_height)), 0};
}

ImageLens::ImageLens(const LensChoice& choice, const Mount& mount)
    : pupil_(choice, mount),
      pixel_aspect_(mount.pixel_aspect),
      near_given_(choice.kernel_images.near != nullptr),
      far_(*choice.kernel_images.far),
      near_(near_given_ ? *choice.kernel_images.near : *choice.kernel_images.far) {}

PointSpread ImageLens::point_spread(double coc_radius_px, FieldPosition field) const {
    const double radius = std::abs(coc_radius_px);
    const int wide = int(std::ceil(radius - 0.5)), tall = int(std::ceil(radius * pixel_aspect_ - 0.5));
    if (wide <= 0 && tall <= 0) return single_pixel();
    // A picture for the near side is taken as it appears there; the far one turns by itself.
    const Channels& picture = coc_radius_px < 0 ? near_ : far_;
    const double scale = coc_radius_px < 0 && near_given_ ? radius : coc_radius_px;
    const double half_width = 0.5 / radius, half_height = half_width / pixel_aspect_;

    const bool cut = !pupil_.is_disc(field);
    const Rect extent{-wide, -tall, wide + 1, tall + 1};
    CoverageBuffer<double> coverage(extent);
    if (cut) {
        std::vector<Point> outline = pupil_.outline(field, 1e-3 / std::max(1.0, radius));
        for (Point& p : outline) p = {coc_radius_px * p.x, coc_radius_px * pixel_aspect_ * p.y};
        coverage.add_polygon(outline, 1);
    }
    PointSpread spread{extent, Image<Rgba>(extent.width(), extent.height()), false};
    for (int y = -tall; y <= tall; ++y) {
        check_cancelled();
        const double* covered = coverage.resolve_row(y + tall);
        for (int x = -wide; x <= wide; ++x) {
            Rgba w = picture.mean({x / scale, y / (scale * pixel_aspect_)}, half_width, half_height);
            if (cut) w *= float(std::max(0.0, covered[x + wide]));
            spread.weights(x + wide, y + tall) = w;
        }
    }
    trim(spread);
    normalise(spread);
    return spread;
}

std::vector<PupilRay> ImageLens::rays(int count, FieldPosition field, std::uint64_t seed) const {
    std::vector<Point> outline{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    if (!pupil_.is_disc(field)) outline = pupil_.outline(field, 1e-4);
    const double half = 1 / std::sqrt(double(count));
    std::vector<PupilRay> rays;
    double r = 0, g = 0, b = 0;
    for (const PupilPoint& p : spread_evenly(outline, count, seed)) {
        const Rgba w = far_.mean(p.place, half, half);
        rays.push_back({float(p.place.x), float(p.place.y * pixel_aspect_), 0, 0, w});
        r += double(w.r), g += double(w.g), b += double(w.b);
    }
    const float even = 1 / float(count);
    for (PupilRay& ray : rays) {
        Rgba& w = ray.weight;
        w.r = r > 0 ? float(double(w.r) / r) : even;
        w.g = g > 0 ? float(double(w.g) / g) : even;
        w.b = b > 0 ? float(double(w.b) / b) : even;
        w.a = luminance(w);
    }
    return rays;
}

double ImageLens::reach_px(double coc_radius_px) const {
    return std::abs(coc_radius_px) * std::max(1.0, pixel_aspect_);
}

}  // namespace petzval::kernel
