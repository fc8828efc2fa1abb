#include "base/parallel.h"
#include "depth/hidden.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace petzval::depth {
namespace {

constexpr float kDark = 1e-3f;  // keeps reciprocals finite
constexpr int kReach = 3;       // clean colours are looked for within so many pixels

bool touches_silhouette(View<const unsigned char> connected, int x, int y) {
    if (connected(x, y) != kAll) return true;
    // Diagonal: a side neighbour is cut from the diagonal pixel.
    const auto cut = [&](int nx, int ny, unsigned char side) {
        return connected.rect().contains(nx, ny) && !(connected(nx, ny) & side);
    };
    return cut(x - 1, y, kUp) || cut(x - 1, y, kDown) || cut(x + 1, y, kUp) || cut(x + 1, y, kDown) ||
           cut(x, y - 1, kLeft) || cut(x, y - 1, kRight) || cut(x, y + 1, kLeft) || cut(x, y + 1, kRight);
}

float distance2(Rgba a, Rgba b) {
    const Rgba d = a - b;
    return d.r * d.r + d.g * d.g + d.b * d.b + d.a * d.a;
}
float dot(Rgba a, Rgba b) { return a.r * b.r + a.g * b.g + a.b * b.b + a.a * b.a; }

// What the neighbourhood of a silhouette's pixel says of the two surfaces that meet there.
struct Sides {
    Rgba near_clean, far_clean;  // weighted sums over clean pixels
    float near_weight = 0, far_weight = 0;
    Rgba near_any, far_any;  // the same over all pixels of that side
    float near_any_weight = 0, far_any_weight = 0;
    float near_coc = 0, far_coc = 0;  // of the closest pixel of that side
    float near_closest = 1e9f, far_closest = 1e9f;
    float near_share_by_shape = 0;  // share of the 3 x 3 tent that shows the nearer surface
};

Sides look_around(View<const Rgba> colour, View<const float> coc, View<const unsigned char> touching, int x,
                  int y, float threshold) {
    Sides s;
    const Rect window = Rect{x - kReach, y - kReach, x + kReach + 1, y + kReach + 1}.intersected(coc.rect());
    const float own_light = std::max(0.0f, luminance(colour(x, y))) + kDark;
    float tent_total = 0;
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            const float d2 = float((u - x) * (u - x) + (v - y) * (v - y));
            const bool near = coc(u, v) <= threshold;
            // Far pixels count little, and pixels much brighter than this one too: a lamp nearby is not this
            // surface.
            const float weight = 1 / ((1 + d2 * d2) * (own_light + std::max(0.0f, luminance(colour(u, v)))));
            if (std::abs(u - x) <= 1 && std::abs(v - y) <= 1) {
                const float tent = (u == x ? 2.0f : 1.0f) * (v == y ? 2.0f : 1.0f);
                tent_total += tent;
                if (near) s.near_share_by_shape += tent;
            }
            if (near) {
                s.near_any += weight * colour(u, v), s.near_any_weight += weight;
                if (!touching(u, v)) s.near_clean += weight * colour(u, v), s.near_weight += weight;
                if (d2 < s.near_closest) s.near_closest = d2, s.near_coc = coc(u, v);
            } else {
                s.far_any += weight * colour(u, v), s.far_any_weight += weight;
                if (!touching(u, v)) s.far_clean += weight * colour(u, v), s.far_weight += weight;
                if (d2 < s.far_closest) s.far_closest = d2, s.far_coc = coc(u, v);
            }
        }
    s.near_share_by_shape /= tent_total;
    return s;
}

// The colour of a thin thing that has no clean pixel: of its pixels nearby, the one least like the far side.
Rgba least_like(Rgba far_colour, View<const Rgba> colour, View<const float> coc, int x, int y,
                float threshold) {
    Rgba best = colour(x, y);
    float largest = -1;
    for (int v = std::max(0, y - 2); v <= std::min(coc.height() - 1, y + 2); ++v)
        for (int u = std::max(0, x - 2); u <= std::min(coc.width() - 1, x + 2); ++u)
            if (coc(u, v) <= threshold && distance2(colour(u, v), far_colour) > largest)
                largest = distance2(colour(u, v), far_colour), best = colour(u, v);
    return best;
}

Mixture taken_apart(View<const Rgba> colour, View<const float> coc, View<const unsigned char> touching, int x,
                    int y) {
    float low = coc(x, y), high = coc(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(coc.height() - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(coc.width() - 1, x + 1); ++u)
            low = std::min(low, coc(u, v)), high = std::max(high, coc(u, v));
    const float threshold = 0.5f * (low + high);
    const Sides s = look_around(colour, coc, touching, x, y, threshold);
    Mixture m;
    m.near_coc_px = s.near_coc, m.far_coc_px = s.far_coc;
    const Rgba c = colour(x, y);
    m.far_colour = s.far_weight > 0 ? s.far_clean * (1 / s.far_weight) : s.far_any * (1 / s.far_any_weight);
    const Rgba near = s.near_weight > 0 ? s.near_clean * (1 / s.near_weight)
                                        : least_like(m.far_colour, colour, coc, x, y, threshold);
    // Where the two colours differ, the pixel's own colour tells its share; where they do not, its shape
    // must.
    const Rgba axis = near - m.far_colour;
    const float length2 = dot(axis, axis);
    const float by_colour = length2 > 0 ? std::clamp(dot(c - m.far_colour, axis) / length2, 0.0f, 1.0f) : 0;
    const float trust = length2 / (length2 + 1e-3f * (1e-3f + dot(c, c)));
    m.near_share = trust * by_colour + (1 - trust) * s.near_share_by_shape;
    // The nearer part is what is left, so that near + far is the pixel again; what would be negative goes to
    // the far side's account.
    const float far_share = 1 - m.near_share;
    Rgba rest = c - far_share * m.far_colour;
    rest = {std::max(0.0f, rest.r), std::max(0.0f, rest.g), std::max(0.0f, rest.b),
            std::clamp(rest.a, 0.0f, 1.0f)};
    if (far_share > 0.05f) {
        const Rgba far = (c - rest) * (1 / far_share);
        m.far_colour = {std::max(0.0f, far.r), std::max(0.0f, far.g), std::max(0.0f, far.b), m.far_colour.a};
    }
    m.near_colour = rest;
    return m;
}

}  // namespace

Sparse<Mixture> unmix_silhouettes(View<const Rgba> colour, View<const float> coc,
                                  View<const unsigned char> connected, int threads) {
    const int width = coc.width(), height = coc.height();
    Image<unsigned char> touching(width, height);
    parallel_for(height, threads, [&](int y) {
        for (int x = 0; x < width; ++x) touching(x, y) = touches_silhouette(connected, x, y);
    });
    std::vector<std::vector<Mixture>> rows(static_cast<std::size_t>(height));
    Sparse<Mixture> mixtures{Image<int>(width, height, -1), {}};
    parallel_for(height, threads, [&](int y) {
        for (int x = 0; x < width; ++x) {
            if (!touching(x, y)) continue;
            mixtures.index(x, y) = int(rows[std::size_t(y)].size());
            rows[std::size_t(y)].push_back(taken_apart(colour, coc, touching, x, y));
        }
    });
    for (int y = 0; y < height; ++y) {
        const int before = int(mixtures.values.size());
        for (int x = 0; x < width; ++x)
            if (mixtures.index(x, y) >= 0) mixtures.index(x, y) += before;
        mixtures.values.insert(mixtures.values.end(), rows[std::size_t(y)].begin(),
                               rows[std::size_t(y)].end());
    }
    return mixtures;
}

}  // namespace petzval::depth
