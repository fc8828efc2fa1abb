#include "engine/samples/silhouettes/rims.h"

#include "engine/samples/silhouettes/two_surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace petzval::engine {
namespace {

constexpr float kBrighter = 2;
constexpr float kMostShare = 0.75f;  // largest near share of a pixel whose middle shows the farther surface
constexpr int kCleanReach = 3;       // in pixels; with their neighbours it makes kRimReachPx
static_assert(kRimReachPx == kCleanReach + 1);

float light_product(Rgba a, Rgba b) { return a.r * b.r + a.g * b.g + a.b * b.b; }

// Pixels of the nearer surface that touch a rim.
struct Nearer {
    Rgba colour;                      // mean colour
    float share = 0;                  // share of the rim's pixel by the shape: a tent over 3 x 3 pixels
    float brightest = 0, coc_px = 0;  // of the brightest pixel
};

// Separation of a rim: its share, and how far its far colour moves from the pixel's own towards that of clean
// pixels.
struct Decision {
    float share, towards_clean;
};

class Finder {
public:
    Finder(View<const Rgba> colour, View<const Rgba> judged, View<const float> coc_px,
           View<const Touched> touched)
        : colour_(colour), judged_(judged), coc_px_(coc_px), touched_(touched) {}

    std::optional<Rim> taken_apart(int x, int y) const {
        const Nearer nearer = nearer_beside(x, y);
        const float own = luminance(judged_(x, y));
        bool bright = nearer.brightest > kBrighter * own;
        Pool clean, clean_of_layer;
        const bool is_layer = colour_.row(0) != judged_.row(0);
        const Rect window = around(x, y, kCleanReach);
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                if (touched_(u, v) != Touched::Clean) continue;
                if (std::abs(coc_px_(u, v) - coc_px_(x, y)) > kUnlikePx) continue;
                bright = bright && kBrighter * luminance(judged_(u, v)) <= own;
                const float weight = 1 / float(1 + (u - x) * (u - x) + (v - y) * (v - y));
                clean.add(judged_(u, v), weight);
                if (is_layer) clean_of_layer.add(colour_(u, v), weight);
            }
        if (clean.empty()) return {};
        const Guess far = clean.guess();
        const Decision decision = bright ? of_bright(own, nearer, far) : of_any(x, y, nearer, far);
        constexpr float kLeastShare = 0.02f;  // smaller shares are ignored, except those of bright light
        if (!bright && decision.share < kLeastShare) return {};
        return rim(x, y, nearer, kept_bright(decision, comparable(judged_(x, y)), far.colour),
                   is_layer ? clean_of_layer.guess().colour : far.colour);
    }

private:
    Rect around(int x, int y, int reach) const {
        return Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(coc_px_.rect());
    }

    Nearer nearer_beside(int x, int y) const {
        Nearer nearer;
        float all = 0;
        const Rect beside = around(x, y, 1);
        for (int v = beside.y0; v < beside.y1; ++v)
            for (int u = beside.x0; u < beside.x1; ++u) {
                const float weight = float((u == x ? 2 : 1) * (v == y ? 2 : 1));
                all += weight;
                if (coc_px_(x, y) - coc_px_(u, v) <= kUnlikePx) continue;
                nearer.share += weight, nearer.colour += weight * judged_(u, v);
                const float light = luminance(judged_(u, v));
                if (light >= nearer.brightest) nearer.brightest = light, nearer.coc_px = coc_px_(u, v);
            }
        nearer.colour *= 1 / nearer.share, nearer.share /= all;
        return nearer;
    }

    static Decision of_bright(float own, const Nearer& nearer, const Guess& far) {
        const float light = luminance(far.colour);
        return {(own - light) / (nearer.brightest - light), 1};
    }

    // The pixel's place between the two colours counts less than the shape, the more the far colours vary and
    // the farther the pixel's colour lies beside them.
    Decision of_any(int x, int y, const Nearer& nearer, const Guess& far) const {
        constexpr float kShapeCounts = 16;
        const Rgba own = comparable(judged_(x, y));
        const Rgba apart = comparable(nearer.colour) - far.colour, from_far = own - far.colour;
        const float apart2 = light_product(apart, apart), along = light_product(apart, from_far);
        const float own2 = light_product(from_far, from_far);
        const float beside = own2 - along * along / std::max(apart2, 1e-12f);
        const float unsure = kShapeCounts * (3 * far.variance + std::max(0.0f, beside)) + 1e-6f;
        const float share = std::clamp((along + unsure * nearer.share) / (apart2 + unsure), 0.0f, kMostShare);
        // Without the share of the nearer colour the pixel's own moves by this towards or past the far one.
        const float moves = share / (1 - share) * (along - own2) / std::max(own2, 1e-12f);
        return {share, std::clamp(moves, 0.0f, 1.0f)};
    }

    // No more light can come from behind than there is.
    static Decision kept_bright(Decision d, Rgba own, Rgba far) {
        const float shares = d.share / std::max(1e-6f, 1 - d.share);
        for (const auto& [c, f] : {std::pair{own.r, far.r}, {own.g, far.g}, {own.b, far.b}, {own.a, far.a}})
            if (f > c) d.towards_clean = std::min(d.towards_clean, shares * std::max(0.0f, c) / (f - c));
        return d;
    }

    Rim rim(int x, int y, const Nearer& nearer, Decision d, Rgba clean) const {
        Rim rim;
        rim.share = d.share, rim.near_coc_px = nearer.coc_px;
        rim.far = colour_(x, y) + d.towards_clean * (clean - colour_(x, y));
        return rim;
    }

    View<const Rgba> colour_, judged_;
    View<const float> coc_px_;
    View<const Touched> touched_;
};

}  // namespace

Image<Touched> find_touched(View<const float> coc_px, Workers& workers) {
    const int width = coc_px.width(), height = coc_px.height();
    auto touched = Image<Touched>::uninitialised(width, height);
    parallel_for(height, workers, [&](int y) {
        const float* const rows[3] = {coc_px.row(std::max(0, y - 1)), coc_px.row(y),
                                      coc_px.row(std::min(height - 1, y + 1))};
        // Extremes of the three pixels of each column, and of one more column at either end.
        std::vector<float> least(std::size_t(width) + 2), most(least.size());
        for (int x = 0; x < width; ++x) {
            least[std::size_t(x) + 1] = std::min(std::min(rows[0][x], rows[1][x]), rows[2][x]);
            most[std::size_t(x) + 1] = std::max(std::max(rows[0][x], rows[1][x]), rows[2][x]);
        }
        least.front() = least[1], least.back() = least[std::size_t(width)];
        most.front() = most[1], most.back() = most[std::size_t(width)];
        Touched* const out = touched.row(y);
        for (int x = 0; x < width; ++x) {
            const float *low = &least[std::size_t(x)], *high = &most[std::size_t(x)];
            const bool by_nearer = rows[1][x] - std::min(std::min(low[0], low[1]), low[2]) > kUnlikePx;
            const bool by_farther = std::max(std::max(high[0], high[1]), high[2]) - rows[1][x] > kUnlikePx;
            out[x] = by_nearer ? Touched::ByNearer : by_farther ? Touched::ByFarther : Touched::Clean;
        }
    });
    return touched;
}

Rims find_rims(View<const Rgba> colour, View<const Rgba> judged, View<const float> coc_px,
               View<const Touched> touched, Workers& workers) {
    const Finder finder(colour, judged, coc_px, touched);
    return Rims(colour.width(), colour.height(), workers, [&](int y, const auto& emit) {
        const Touched* const row = touched.row(y);
        for (int x = 0; x < colour.width(); ++x)
            if (row[x] == Touched::ByNearer)
                if (const auto rim = finder.taken_apart(x, y)) emit(x, *rim);
    });
}

}  // namespace petzval::engine
