#include "engine/samples/known_surfaces.h"

#include "base/parallel.h"

#include <algorithm>

namespace petzval::engine {
namespace {

constexpr float kDark = 0.01f;        // times white; keeps ratios finite
constexpr float kWidestLightPx = 64;  // what is wider is a lit surface, as of lamps

float light_of(Rgba c) { return std::max(0.0f, luminance(c)); }

// 0 up to `from`, 1 at twice that.
float above(float value, float from) { return std::clamp(value / from - 1, 0.0f, 1.0f); }

Plane known_radii(View<const float> coc, const Sparse<Mixture>& mixtures, Workers& workers) {
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

KnownSurfaces::KnownSurfaces(const LitPicture& picture, View<const float> coc,
                             const Sparse<Mixture>& mixtures, float white, Workers& workers)
    : picture_(picture),
      mixtures_(mixtures),
      radii_(known_radii(coc, mixtures, workers)),
      white_(white),
      edges_(picture, radii_, mixtures, white, workers) {}

Rgba KnownSurfaces::going_on(Place from, Direction outwards, float distance_px) const {
    // Times white: what is darker is no light, a bright wall may go on as long as it likes.
    constexpr float kLight = 0.55f;
    // Times what is beyond.
    constexpr float kStandsOut = 3;
    const Rgba own = wide_colour(from, outwards, distance_px);
    const float light = light_of(own);
    if (white_ <= 0 || light <= kLight * white_) return own;
    const Rgba other = beyond(from, outwards, distance_px, own);
    const float t = above(light / (light_of(other) + kDark * white_), kStandsOut);
    const float falls = above(light, kLight * white_) * t * t * (3 - 2 * t);
    return own * (1 - falls) + falls * other;
}

Rgba KnownSurfaces::wide_colour(Place at, Direction outwards, float distance_px) const {
    const CutEdges::Point hidden{at.x - int(std::lround(distance_px * outwards.x)),
                                 at.y - int(std::lround(distance_px * outwards.y))};
    Rgba sum = colour(at.x, at.y);
    float total = 1;
    for (const float aside : {-0.2f, -0.1f, 0.1f, 0.2f}) {
        const float far = aside * distance_px;
        const int dx = -int(std::lround(far * outwards.y)), dy = int(std::lround(far * outwards.x));
        const int x = at.x + dx, y = at.y + dy;
        if ((dx == 0 && dy == 0) || !shows(x, y, at.coc_px)) continue;
        const float weight = edges_.passes({x, y}, hidden, at.coc_px);
        sum += weight * colour(x, y), total += weight;
    }
    return sum * (1 / total);
}

// What shows of the surface from `from` to once the distance, dark things before bright ones: what shows
// wider than it is asked to go on does so. (Four times: a lit window of the path-traced fence, most of which
// shows, ends at the leaf before it, 1.1 dB of the whole picture.)
Rgba KnownSurfaces::beyond(Place from, Direction outwards, float distance_px, Rgba otherwise) const {
    constexpr float kNearest = 0.3f, kFarthest = 1, kStep = 1.3f;  // the first two times the distance
    const float farthest = std::min(kFarthest * distance_px, kWidestLightPx);
    const float dark = kDark * white_;
    Rgba sum;
    float total = 0;
    for (float far = kNearest * distance_px; far <= farthest; far *= kStep) {
        const int x = from.x + int(std::lround(far * outwards.x)),
                  y = from.y + int(std::lround(far * outwards.y));
        if (!radii_.rect().contains(x, y)) break;
        if (!one_surface(radii_(x, y), from.coc_px)) continue;
        const Rgba c = comparable(colour(x, y));
        const float light = light_of(c) + dark, weight = 1 / (light * light);
        sum += weight * c, total += weight;
    }
    return total > 0 ? sum * (1 / total) : otherwise;
}

}  // namespace petzval::engine
