#include "engine/lights/part_of_pixel.h"

#include "kernel/model/gamut.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace petzval::engine {
namespace {

// Light along an axis, in pixels from the middle of its pixel.
struct Span {
    double middle, width;
};

Span span_of(int part) {
    if (part == PartOfPixel::kPoint) return {0, 0};
    if (part == PartOfPixel::kWhole) return {0, 1};
    return {part / 8.0, 1 - std::abs(part) / 4.0};
}

// A span lies in two pixels: the first of them, and the share in the second.
struct Landed {
    int first;
    float second;
};

Landed landed(const Span& span, double moved_px) {
    const double begin = span.middle + moved_px - span.width / 2 + 0.5;
    const double first = std::floor(begin);
    const double beyond = begin + span.width - (first + 1);
    return {int(first), beyond > 0 ? float(beyond / span.width) : 0.0f};
}

}  // namespace

int part_along(float before, float own, float after) {
    constexpr float kLit = 0.125f;  // of the pixel's light: parts are known to an eighth
    const float bright = std::max(before, after);
    const float dark = std::max(0.0f, std::min(before, after));
    if (own <= 0 || bright <= kLit * own) return PartOfPixel::kPoint;
    // The brightest pixel of all may be full or not: seven eighths are the best guess of a lamp of any size.
    const float empty = bright > own ? (bright - own) / (bright - dark) : 0;
    const float moved = std::clamp(4 * empty, 1.0f, float(PartOfPixel::kMostEighths));
    const float eighths = moved * std::max(0.0f, 1 - dark / std::min(own, bright));
    if (!(eighths >= 0.5f)) return PartOfPixel::kWhole;  // where light is infinite, too
    return after > before ? int(eighths + 0.5f) : -int(eighths + 0.5f);
}

kernel::PointSpread spread_of_part(const kernel::LensModel& lens, double coc_radius_px,
                                   kernel::FieldPosition field, PartOfPixel part) {
    constexpr double kRaysPerPixel = 128;
    constexpr int kLeastRays = 1024;
    const int rays = kLeastRays + int(kRaysPerPixel * M_PI * coc_radius_px * coc_radius_px);
    const int reach = int(std::ceil(lens.reach_px(coc_radius_px))) + 2;
    kernel::PointSpread spread{
        {-reach, -reach, reach + 1, reach + 1}, Picture(2 * reach + 1, 2 * reach + 1), false};
    const Span across = span_of(part.x), down = span_of(part.y);
    for (const kernel::PupilRay& ray : lens.rays(rays, field, 1)) {
        const Landed x = landed(across, coc_radius_px * double(ray.x) + double(ray.offset_x_px));
        const Landed y = landed(down, coc_radius_px * double(ray.y) + double(ray.offset_y_px));
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 2; ++i) {
                const float share = (i ? x.second : 1 - x.second) * (j ? y.second : 1 - y.second);
                spread.weights(x.first + i + reach, y.first + j + reach) += share * ray.weight;
            }
    }
    kernel::normalise(spread);
    kernel::map_into_gamut(spread);
    kernel::trim(spread);
    return spread;
}

}  // namespace petzval::engine
