#include "engine/samples/silhouettes/bridges.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/silhouettes/two_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

namespace petzval::engine {
namespace {

constexpr int kTurns = 16;                                  // directions of a step
constexpr int kLongestPx = 2 * SparseRows<Mixture>::kBand;  // of a gap; a strand's colour is known as far
// Light that a tip takes from the surface behind, relative to the strand: more is a line of that surface, and
// the tip ends where it takes less.
constexpr float kMostAtTip = 1.3f, kLeastAtTip = 0.25f;

struct Pixel {
    int x, y;
};

struct Gap {
    std::vector<Pixel> pixels;
    float from_px, to_px;  // radii of the strand at its ends
};

class GapFinder {
public:
    GapFinder(const LitPicture& picture, View<const float> coc) : picture_(picture), coc_(coc) {
        for (int k = 0; k < kTurns; ++k) {
            const double angle = 2 * M_PI * k / kTurns;
            steps_[std::size_t(k)] = {float(std::cos(angle)), float(std::sin(angle))};
        }
    }

    // Appends the gaps that begin at the pixel if a strand ends there.
    void find(int x, int y, std::vector<Gap>& gaps) const {
        if (!is_thin(x, y)) return;
        constexpr int kBeside = 8, kEnds = 2, kApart = 5;  // a gap begins away from what continues the strand
        std::array<int, kBeside> beside{};
        int count = 0;
        for (int k = 0; k < kTurns; k += kTurns / kBeside)
            if (continues(x, y, k)) beside[std::size_t(count++)] = k;
        if (count > kEnds) return;
        for (int k = 0; k < kTurns; ++k)
            if (std::none_of(beside.begin(), beside.begin() + count, [k](int b) {
                    const int turn = std::abs(k - b);
                    return std::min(turn, kTurns - turn) <= kApart;
                }))
                follow(x, y, k, gaps);
    }

private:
    Direction step(int k) const { return steps_[std::size_t((k + kTurns) % kTurns)]; }
    bool continues(int x, int y, int k) const {
        constexpr float kNextPx = 1.2f;  // reaches the next pixel in all eight directions
        const int u = x + nearest_pixel(kNextPx * step(k).x), v = y + nearest_pixel(kNextPx * step(k).y);
        return coc_.rect().contains(u, v) && one_surface(coc_(u, v), coc_(x, y));
    }
    // Farther surfaces show within 2 px on two opposite sides.
    bool is_thin(int x, int y) const {
        constexpr int kWide = 2;
        if (x < kWide || y < kWide || x + kWide >= coc_.width() || y + kWide >= coc_.height()) return false;
        const float own = coc_(x, y) + completion_model.apart_px();
        const auto far = [&](int dx, int dy) {
            return coc_(x + dx, y + dy) > own || coc_(x + 2 * dx, y + 2 * dy) > own;
        };
        const auto between = [&](int dx, int dy) { return far(dx, dy) && far(-dx, -dy); };
        return between(1, 0) || between(0, 1) || between(1, 1) || between(1, -1);
    }
    // A pixel that shows a farther surface on one side (-1, 1) of a strand in direction k: the one two away,
    // or the one next to the strand where another strand is two away.
    std::optional<Pixel> aside(int x, int y, int k, int side, float before_px) const {
        for (const int apart : {2, 1}) {
            const Pixel at{x + nearest_pixel(float(-side * apart) * step(k).y),
                           y + nearest_pixel(float(side * apart) * step(k).x)};
            if (coc_.rect().contains(at.x, at.y) && coc_(at.x, at.y) > before_px) return at;
        }
        return {};
    }
    // The light that a strand in direction k takes from the surface behind it; nothing if that is not what
    // shows on both sides, changes there by itself as much, or is lit by a lamp.
    std::optional<Rgba> taken(int x, int y, int k, float before_px) const {
        const std::optional<Pixel> left = aside(x, y, k, -1, before_px), right = aside(x, y, k, 1, before_px);
        if (!left || !right) return {};
        for (const Pixel at : {*left, Pixel{x, y}, *right})
            if (picture_.dim(at.x, at.y) != picture_.colour(at.x, at.y)) return {};
        const Rgba a = comparable(picture_.dim(left->x, left->y));
        const Rgba b = comparable(picture_.dim(right->x, right->y));
        const Rgba less = 0.5f * (a + b) - comparable(picture_.dim(x, y));
        if (distance2(a, b) >= dot(less, less)) return {};
        return less;
    }
    // Goes from pixel to pixel, to the one ahead that differs most from its sides as the strand does. What
    // leads to no other pixel of the strand is its tip, up to where it fades.
    void follow(int x, int y, int k, std::vector<Gap>& gaps) const {
        const float own = coc_(x, y), behind = own + completion_model.apart_px();
        const std::optional<Rgba> strand = taken(x, y, k, behind);
        if (!strand) return;
        const float all = dot(*strand, *strand);
        Gap gap{{}, own, own};
        std::optional<std::size_t> tip;  // number of its pixels, once known
        Direction at{float(x), float(y)};
        while (gap.pixels.size() < std::size_t(kLongestPx)) {
            float most = 0;
            int turned = 0;
            for (const int turn : {0, -1, 1}) {
                const int u = nearest_pixel(at.x + step(k + turn).x),
                          v = nearest_pixel(at.y + step(k + turn).y);
                if (!coc_.rect().contains(u, v)) continue;
                if (coc_(u, v) <= behind && one_surface(coc_(u, v), own)) {
                    gap.to_px = coc_(u, v);
                    return keep(std::move(gap), gaps);
                }
                if (coc_(u, v) <= behind) return keep_tip(std::move(gap), tip, gaps);
                const std::optional<Rgba> here = taken(u, v, k + turn, behind);
                if (here && dot(*here, *strand) > most) most = dot(*here, *strand), turned = turn;
            }
            if (!tip && most > kMostAtTip * all) tip = 0;
            if (!tip && most < kLeastAtTip * all) tip = gap.pixels.size();
            if (most <= 0) break;
            k += turned;
            at = {at.x + step(k).x, at.y + step(k).y};
            gap.pixels.push_back({nearest_pixel(at.x), nearest_pixel(at.y)});
        }
        keep_tip(std::move(gap), tip, gaps);
    }
    static void keep(Gap gap, std::vector<Gap>& gaps) {
        if (!gap.pixels.empty()) gaps.push_back(std::move(gap));
    }
    static void keep_tip(Gap gap, std::optional<std::size_t> pixels, std::vector<Gap>& gaps) {
        gap.pixels.resize(pixels.value_or(0));
        keep(std::move(gap), gaps);
    }

    const LitPicture& picture_;
    View<const float> coc_;
    std::array<Direction, kTurns> steps_;
};

Plane copy_of(View<const float> from) {
    Plane plane(from.width(), from.height());
    for (int y = 0; y < from.height(); ++y) std::copy_n(from.row(y), from.width(), plane.row(y));
    return plane;
}

}  // namespace

Plane bridged_strands(const LitPicture& picture, View<const float> coc, View<const unsigned char> connected,
                      Workers& workers) {
    const GapFinder finder(picture, coc);
    std::vector<std::vector<Gap>> rows(std::size_t(coc.height()));
    parallel_for(coc.height(), workers, [&](int y) {
        for (int x = 0; x < coc.width(); ++x)
            if (connected(x, y) != kAll) finder.find(x, y, rows[std::size_t(y)]);
    });
    Plane bridged;
    for (const auto& row : rows)
        for (const Gap& gap : row) {
            if (bridged.width() == 0) bridged = copy_of(coc);
            for (std::size_t i = 0; i < gap.pixels.size(); ++i) {
                const float share = float(i + 1) / float(gap.pixels.size() + 1);
                float& at = bridged(gap.pixels[i].x, gap.pixels[i].y);
                at = std::min(at, (1 - share) * gap.from_px + share * gap.to_px);
            }
        }
    return bridged;
}

}  // namespace petzval::engine
