#include "session/rendered/light_points.h"

#include <cmath>

namespace petzval {

std::vector<LightPoint> drawable_points(const Rendered& rendered,
                                        const std::function<float(float depth_m)>& radius_px,
                                        std::vector<std::string>& warnings) {
    constexpr float kFarthestPx = 1e6f;  // from the frame: no lens throws light so far
    std::vector<LightPoint> points;
    if (!rendered.lights) return points;
    points.reserve(rendered.lights->size());
    std::size_t not_finite = 0, negative = 0, outside = 0, in_first_pixel = 0;
    for (LightPoint p : *rendered.lights) {
        const bool has_depth = !std::isnan(p.depth_m);
        const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.r) &&
                            std::isfinite(p.g) && std::isfinite(p.b) && std::isfinite(p.diameter_px) &&
                            (has_depth || std::isfinite(p.coc_px));
        if (!finite || std::abs(p.x) > kFarthestPx || std::abs(p.y) > kFarthestPx) {
            ++not_finite;
            continue;
        }
        if (p.r < 0 || p.g < 0 || p.b < 0 || p.diameter_px < 0 || (has_depth && p.depth_m < 0)) {
            ++negative;
            continue;
        }
        if (p.x < 0 || p.y < 0 || p.x >= float(rendered.colour.width()) ||
            p.y >= float(rendered.colour.height()))
            ++outside;
        in_first_pixel += p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1;
        // A point's depth has no meaning beside radii of the picture.
        if (has_depth && !has_radii(rendered)) p.coc_px = radius_px(p.depth_m);
        points.push_back(p);
    }
    const auto report = [&](std::size_t count, const char* what) {
        if (count > 0)
            warnings.push_back(std::to_string(count) + " of " + std::to_string(rendered.lights->size()) +
                               " given points " + what);
    };
    report(not_finite, "are not finite and were left out");
    report(negative, "have negative light, depth or size and were left out");
    if (in_first_pixel > 1 && in_first_pixel == points.size())
        report(in_first_pixel, "lie in the first pixel: x and y are pixels, not fractions of the frame");
    report(outside, "lie outside the frame; parts of their discs inside it are drawn");
    return points;
}

}  // namespace petzval
