#include "shot/other_lamps.h"

#include <cmath>
#include <cstddef>

namespace petzval::shot {
namespace {

constexpr float kLit = 0.25f;  // of a lamp's light where it fills a pixel

bool same_depth(float a, float b) { return a == b || std::max(a, b) <= kOneDepth * std::min(a, b); }

bool alike(Rgba a, Rgba b) {
    constexpr float kAlike = 0.95f;  // squared cosine
    const auto dot = [](Rgba p, Rgba q) { return p.r * q.r + p.g * q.g + p.b * q.b; };
    const float both = dot(a, b);
    return both > 0 && both * both >= kAlike * dot(a, a) * dot(b, b);
}

// True if a pixel's light is that of a small lamp with the pixel's depth: its whole surface nearby is lit,
// most of everything else is dark. At the border of the picture no pixel counts as one.
bool is_lamp(const Shot& shot, View<const float> depth, int x, int y) {
    constexpr int kAround = 2, kLeastOthers = 17;  // px
    constexpr float kStandsOut = 8;                // times the light around
    if (!depth.rect().grown(-kAround).contains(x, y)) return false;
    const float light = luminance(shot.colour(x, y)), own = depth(x, y);
    const auto is_dark = [&](int u, int v) { return kStandsOut * luminance(shot.colour(u, v)) <= light; };
    if (!(own > 0 && light > 0) || std::isinf(own)) return false;
    if (!is_dark(x - kAround, y - kAround) && !is_dark(x + kAround, y + kAround)) return false;
    int dark = 0, others = 0;
    for (int v = y - kAround; v <= y + kAround; ++v)
        for (int u = x - kAround; u <= x + kAround; ++u) {
            if (!same_depth(depth(u, v), own))
                ++others, dark += is_dark(u, v);
            else if (luminance(shot.colour(u, v)) < kLit * light)
                return false;
        }
    return others >= kLeastOthers && 2 * dark > others;
}

}  // namespace

void OtherLamps::add(const Shot& other, const Image<Landing>& landings, float share, Workers& workers) {
    const View<const float> depth = other.depth_plane();
    std::vector<std::vector<int>> found(std::size_t(depth.height()));
    for_rows(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x)
            if (is_lamp(other, depth, x, y)) found[std::size_t(y)].push_back(x);
    });
    for (int y = 0; y < depth.height(); ++y)
        for (const int x : found[std::size_t(y)]) place(other.colour(x, y), landings(x, y), share);
}

// Within a pixel nobody knows where it is: it lights the brightest of those around. If that has the depth of
// another lamp, it keeps it: two lamps of one pixel would take turns from frame to frame.
void OtherLamps::place(Rgba light, const Landing& at, float share) {
    const View<const float> depth = shot_.depth_plane();
    const float left = std::floor(at.x), top = std::floor(at.y);
    if (!(at.depth_m > 0 && left >= 1 && top >= 1 && left < float(depth.width() - 1) &&
          top < float(depth.height() - 1)))
        return;
    const int x = int(left), y = int(top);
    float brightest = kLit * luminance(light);
    std::pair<int, int> lit{-1, -1};
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
            if (same_depth(depth(u, v), at.depth_m)) return;
            const Rgba there = shot_.colour(u, v);
            if (luminance(there) < brightest || !alike(there, light)) continue;
            brightest = luminance(there), lit = {v, u};
        }
    if (lit.first >= 0) {
        if (!is_lamp(shot_, depth, lit.second, lit.first)) depths_m_.emplace(lit, at.depth_m);
    } else if (kSilhouette * depth(x, y) < at.depth_m) {
        const Rgba shows = share * light;
        hidden_.emplace(std::pair{y, x}, DeepSample{{shows.r, shows.g, shows.b, 1}, at.depth_m, at.depth_m});
    }
}

std::vector<SeenElsewhere::Lamp> OtherLamps::depths() const {
    std::vector<SeenElsewhere::Lamp> lamps;
    for (const auto& [place, depth_m] : depths_m_) lamps.push_back({place.second, place.first, depth_m});
    return lamps;
}

void OtherLamps::hide(std::vector<DeepSample>& known) const {
    const int width = shot_.colour.width();
    for (const auto& [place, lamp] : hidden_) {
        DeepSample& there = known[std::size_t(place.first) * std::size_t(width) + std::size_t(place.second)];
        if (!(there.colour.a > 0 && there.depth < lamp.depth)) there = lamp;
    }
}

}  // namespace petzval::shot
