#include "engine/reference/lens_ray.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// A surface that is nearer by less than this is the source's own, or cannot be distinguished from it.
constexpr double kOwnSurfacePx = 0.02;
// Below this radius a tap is as wide as much of the pupil: rays are counted instead of taps probed.
constexpr double kFewTapsPx = 4;
constexpr int kRays = 1024;
constexpr int kProbes = 3;  // per side of a tap

// The facet as a plane: radius at its centre and its slope per pixel.
struct Slope {
    double x, y;
};
Slope slope_of(const Facet& f) {
    const float* c = f.corner_coc_px;
    return {0.5 * (c[1] + c[3] - c[0] - c[2]), 0.5 * (c[2] + c[3] - c[0] - c[1])};
}

// Does the ray cross the facet inside its pixel, at a radius of at most farthest_px?
bool crosses(const Facet& facet, int px, int py, const RaySource& s, double u, double v, double farthest_px) {
    const Slope g = slope_of(facet);
    const double speed = 1 + g.x * u + g.y * v;
    if (std::abs(speed) < 1e-6) return false;
    // c = c_f + g . (q(c) - centre), solved for c.
    const double c =
        (facet.coc_px + g.x * (s.x + s.coc_px * u - px - 0.5) + g.y * (s.y + s.coc_px * v - py - 0.5)) /
        speed;
    if (c > farthest_px) return false;
    const double qx = s.x + (s.coc_px - c) * u - px, qy = s.y + (s.coc_px - c) * v - py;
    // A hair wider than the pixel, so that no ray slips between two.
    constexpr double kHair = 1e-9;
    return qx >= -kHair && qx <= 1 + kHair && qy >= -kHair && qy <= 1 + kHair;
}

// The share of a ray that gets past the facets of pixel (x, y). The first `in_front` of them lie in front of
// the source whatever their radii say: they come before it in its own pixel.
float share_let_through(const Surfaces& surfaces, int x, int y, const RaySource& source, int in_front,
                        double u, double v, float chance) {
    float open = 1;
    int k = 0;
    for (const Facet& facet : surfaces.at(x, y)) {
        if (facet.coc_px > source.coc_px) break;  // nearest first: the rest lies behind the source
        const double farthest_px = k++ < in_front ? 1e30 : source.coc_px - kOwnSurfacePx;
        if (!crosses(facet, x, y, source, u, v, farthest_px)) continue;
        if (!surfaces.dims_itself() && facet.takes(double(chance))) return 0;
        if (surfaces.dims_itself()) open *= 1 - facet.coverage;
    }
    return open;
}

// A fixed sequence of chances that differ from ray to ray: multiples of the golden ratio.
float chance_of(int ray) { return float(std::fmod(0.5 + 0.6180339887498949 * ray, 1.0)); }

kernel::PointSpread by_counting_rays(const Surfaces& surfaces, const kernel::LensModel& lens,
                                     kernel::FieldPosition field, const RaySource& source,
                                     kernel::PointSpread spread) {
    const Rect extent = spread.extent;
    Plane seen(extent.width(), extent.height()), all(extent.width(), extent.height());
    int ray_index = 0;
    for (const kernel::PupilRay& ray : lens.rays(kRays, field, 1)) {
        const double dx = 0.5 + source.coc_px * ray.x + ray.offset_x_px,
                     dy = 0.5 + source.coc_px * ray.y + ray.offset_y_px;
        const int x = std::clamp(int(std::floor(dx)) - extent.x0, 0, extent.width() - 1);
        const int y = std::clamp(int(std::floor(dy)) - extent.y0, 0, extent.height() - 1);
        all(x, y) += 1;
        seen(x, y) += share_seen(surfaces, source, ray.x, ray.y, chance_of(ray_index++));
    }
    double seen_total = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) seen_total += double(seen.pixels()[i]);
    for (int y = 0; y < extent.height(); ++y)
        for (int x = 0; x < extent.width(); ++x)
            spread.weights(x, y) *= all(x, y) > 0 ? seen(x, y) / all(x, y) : float(seen_total / kRays);
    return spread;
}

kernel::PointSpread by_probing_taps(const Surfaces& surfaces, const RaySource& source,
                                    kernel::PointSpread spread) {
    const Rect extent = spread.extent;
    int probe_index = 0;
    for (int y = extent.y0; y < extent.y1; ++y)
        for (int x = extent.x0; x < extent.x1; ++x) {
            Rgba& weight = spread.weights(x - extent.x0, y - extent.y0);
            if (weight == Rgba{}) continue;
            float seen = 0;
            for (int j = 0; j < kProbes; ++j)
                for (int i = 0; i < kProbes; ++i) {
                    double u = (x - 0.5 + (i + 0.5) / kProbes) / source.coc_px;
                    double v = (y - 0.5 + (j + 0.5) / kProbes) / source.coc_px;
                    seen += share_seen(surfaces, source, u, v, chance_of(probe_index++));
                }
            weight *= seen / float(kProbes * kProbes);
        }
    return spread;
}

}  // namespace

RaySource ray_source(const Surfaces& surfaces, int x, int y, double coc_px, double pupil_reach) {
    RaySource source{x + 0.5, y + 0.5, coc_px, coc_px};
    const Rect area = surfaces.area();
    for (int by = 0; by < surfaces.blocks_y(); ++by)
        for (int bx = 0; bx < surfaces.blocks_x(); ++bx) {
            const double c = surfaces.block(bx, by).min;
            if (c >= coc_px - kOwnSurfacePx || c >= source.nearest_coc_px) continue;
            const double reach = (coc_px - c) * pupil_reach + 1;
            const double x0 = area.x0 + bx * Surfaces::kBlock, y0 = area.y0 + by * Surfaces::kBlock;
            const double dx = std::max({x0 - source.x, source.x - x0 - Surfaces::kBlock, 0.0});
            const double dy = std::max({y0 - source.y, source.y - y0 - Surfaces::kBlock, 0.0});
            if (dx * dx + dy * dy <= reach * reach) source.nearest_coc_px = c;
        }
    return source;
}

float share_seen(const Surfaces& surfaces, const RaySource& source, double u, double v, float chance) {
    // Walk the pixels under the ray's path (Amanatides and Woo, "A fast voxel traversal algorithm", 1987);
    // the path parameter is the radius given up, 0 at the source.
    if (source.is_free()) return 1;
    const double end = source.coc_px - source.nearest_coc_px;
    const Rect area = surfaces.area();
    int px = int(std::floor(source.x)), py = int(std::floor(source.y));
    const int step_x = u > 0 ? 1 : -1, step_y = v > 0 ? 1 : -1;
    const double never = 1e30;
    const double per_x = u != 0 ? 1 / std::abs(u) : never, per_y = v != 0 ? 1 / std::abs(v) : never;
    double next_x = u != 0 ? (u > 0 ? px + 1 - source.x : source.x - px) * per_x : never;
    double next_y = v != 0 ? (v > 0 ? py + 1 - source.y : source.y - py) * per_y : never;
    float open = 1;  // share of the ray that translucent facets let through
    for (double along = 0; along <= end;) {
        if (!area.contains(px, py)) return open;
        const bool own_pixel = along == 0;
        open *= share_let_through(surfaces, px, py, source, own_pixel ? source.in_front : 0, u, v, chance);
        if (open <= 0) return 0;
        if (next_x < next_y)
            along = next_x, next_x += per_x, px += step_x;
        else
            along = next_y, next_y += per_y, py += step_y;
    }
    return open;
}

kernel::PointSpread visible_point_spread(const Surfaces& surfaces, const kernel::LensModel& lens,
                                         kernel::FieldPosition field, const BrightPoint& point,
                                         double pupil_reach) {
    const double coc_px = double(point.coc_px);
    kernel::PointSpread spread = lens.point_spread(coc_px, field);
    RaySource source = ray_source(surfaces, point.x, point.y, coc_px, pupil_reach);
    if (surfaces.dims_itself()) source.in_front = point.in_front;
    if (source.is_free()) return spread;
    if (std::abs(coc_px) < kFewTapsPx)
        return by_counting_rays(surfaces, lens, field, source, std::move(spread));
    return by_probing_taps(surfaces, source, std::move(spread));
}

}  // namespace petzval::engine
