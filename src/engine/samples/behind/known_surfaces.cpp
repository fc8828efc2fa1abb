#include "engine/samples/behind/known_surfaces.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>

namespace petzval::engine {
namespace {

float light_of(Rgba c) { return std::max(0.0f, luminance(c)); }

// 0 up to `from`, 1 at twice that.
float above(float value, float from) { return std::clamp(value / from - 1, 0.0f, 1.0f); }

Plane known_radii(View<const float> coc, const Mixtures& mixtures, Workers& workers) {
    Plane radii = Plane::uninitialised(coc.width(), coc.height());
    parallel_for(coc.height(), workers, [&](int y) {
        for (int x = 0; x < coc.width(); ++x) {
            const Mixture* m = mixtures.at(x, y);
            radii(x, y) = !m ? coc(x, y) : m->shows_far ? m->far_coc_px : -1e30f;
        }
    });
    return radii;
}

}  // namespace

KnownSurfaces::KnownSurfaces(const LitPicture& picture, View<const float> coc, const Mixtures& mixtures,
                             float white, Workers& workers, float edges_to_px)
    : picture_(picture),
      mixtures_(mixtures),
      radii_(known_radii(coc, mixtures, workers)),
      white_(white),
      edges_(picture, radii_, mixtures, white, edges_to_px, workers) {
    if (!picture.patches.empty()) add_patches(workers);
}

void KnownSurfaces::add_patches(Workers& workers) {
    parallel_for(radii_.height(), workers, [&](int y) {
        for (int x = 0; x < radii_.width(); ++x)
            if (is_patch(x, y)) radii_(x, y) = picture_.patches.coc_px(x, y);
    });
}

Rgba KnownSurfaces::going_on(Place from, Direction outwards, float distance_px,
                             const CutEdges::Around& edges) const {
    const Rgba own = colour(from.x, from.y);
    if (white_ <= 0) return own;
    const float falls = above(light_of(own), completion_model.light * white_);
    return falls > 0 ? own * (1 - falls) + falls * shown(from, outwards, distance_px, own, edges) : own;
}

// The mean of the visible surface at r distances, with density 1/(1 + r)^2: a thing visible for a width w
// gets the share w/(w + distance). This assumes that things of all widths are equally common and cut
// anywhere. Pixels beyond a continuing edge do not count.
Rgba KnownSurfaces::shown(Place from, Direction outwards, float distance_px, Rgba otherwise,
                          const CutEdges::Around& edges) const {
    constexpr int kParts = 8;  // parts of equal probability
    Rgba sum;
    float total = 0;
    for (int part = 0; part < kParts; ++part) {
        const float nearer = (float(part) + 0.5f) / kParts;
        const float far = distance_px * nearer / (1 - nearer);
        const int x = from.x + nearest_pixel(far * outwards.x), y = from.y + nearest_pixel(far * outwards.y);
        if (far > completion_model.lit_widest_px || !radii_.rect().contains(x, y)) break;
        if (!one_surface(radii_(x, y), from.coc_px)) continue;
        const Rgba light = comparable(colour(x, y));
        const float weight = edges.passes({x, y}, from.coc_px);
        sum += weight * light;
        total += weight;
    }
    return total > 0 ? sum * (1 / total) : otherwise;
}

Slope KnownSurfaces::slope(int x, int y) const {
    constexpr float kBend = 0.1f;  // px; of a plane, by the rounding of its depth
    const float here = radii_(x, y);
    const auto along = [&](int dx, int dy) {
        float sum = 0, sides = 0;
        for (const int side : {-1, 1}) {
            const int u = x + 2 * side * dx, v = y + 2 * side * dy;
            if (!radii_.rect().contains(u, v)) continue;
            const float middle = radii_(x + side * dx, y + side * dy);
            const float first = middle - here, second = radii_(u, v) - middle;
            if (std::abs(first) > completion_model.step_px) continue;
            if (std::abs(first - second) > kBend + completion_model.slope_tolerance * std::abs(first))
                continue;
            sum += 0.5f * float(side) * (first + second);
            ++sides;
        }
        return sides > 0 ? sum / sides : 0;
    };
    return {along(1, 0), along(0, 1)};
}

}  // namespace petzval::engine
