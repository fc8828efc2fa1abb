#include "depth/hidden.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::depth {
namespace {

constexpr int kDirections = 32;      // even: opposite directions are paired
constexpr float kBehindPx = 1.0f;    // farther by less than this in radius is not worth filling
constexpr float kPastEdgePx = 2.0f;  // how far beyond the reach of the blur to look

struct Found {
    bool found = false;
    Rgba colour;
    float coc_px = 0, distance_px = 0;
};

struct Direction {
    float x, y;
};
std::array<Direction, kDirections> directions() {
    std::array<Direction, kDirections> all{};
    for (int k = 0; k < kDirections; ++k) {
        const double angle = 2 * M_PI * (k + 0.5) / kDirections;
        all[std::size_t(k)] = {float(std::cos(angle)), float(std::sin(angle))};
    }
    return all;
}

class Filler {
public:
    Filler(View<const Rgba> colour, View<const float> coc, View<const unsigned char> connected,
           const Sparse<Mixture>& mixtures)
        : colour_(colour), coc_(coc), connected_(connected), mixtures_(mixtures) {
        for (int y = 0; y < coc.height(); ++y)
            for (int x = 0; x < coc.width(); ++x) farthest_ = std::max(farthest_, coc(x, y));
    }

    // What lies behind (x, y), if any surface nearby does.
    bool fill(int x, int y, Hidden& hidden) const {
        const float own = coc_(x, y);
        if (farthest_ < own + kBehindPx) return false;
        static const std::array<Direction, kDirections> all = directions();
        std::array<Found, kDirections> found;
        bool any = false;
        const Slope slope = slope_at(coc_, connected_, x, y);
        for (int k = 0; k < kDirections; ++k) {
            found[std::size_t(k)] = search(x, y, own, slope, all[std::size_t(k)]);
            any = any || found[std::size_t(k)].found;
        }
        if (!any) return false;
        hidden = combined(found);
        return true;
    }

private:
    // The first clean pixel of a farther surface, walking from (x, y).
    Found search(int x, int y, float own, Slope slope, Direction d) const {
        const float longest = std::abs(own) + std::abs(farthest_) + kPastEdgePx;
        float t = 1;
        while (t <= longest) {
            const int u = x + int(std::lround(t * d.x)), v = y + int(std::lround(t * d.y));
            if (!coc_.rect().contains(u, v)) return {};
            const float c = coc_(u, v);
            const float own_here = own + t * (slope.x * d.x + slope.y * d.y);
            if (c > std::max(own, own_here) + kBehindPx && mixtures_.index(u, v) < 0) {
                if (t > std::abs(own) + std::abs(c) + kPastEdgePx) return {};
                return {true, colour_(u, v), c, t};
            }
            t += t < 16 ? 1.0f : t / 16;
        }
        return {};
    }

    static float likeness(const Found& a, const Found& b) {
        const Rgba d = a.colour - b.colour, m = a.colour + b.colour;
        const float difference = d.r * d.r + d.g * d.g + d.b * d.b;
        const float level = 0.25f * (m.r * m.r + m.g * m.g + m.b * m.b);
        const float depth = a.coc_px - b.coc_px;
        return 1 / (0.003f + difference / (level + 0.003f) + 0.02f * depth * depth);
    }

    static Hidden combined(const std::array<Found, kDirections>& found) {
        constexpr int kPairs = kDirections / 2;
        // A surface must be chosen first: the depth that most of the weight agrees on.
        struct Vote {
            Rgba colour;
            float coc, weight;
        };
        std::array<Vote, kDirections> votes{};
        int n = 0;
        for (int k = 0; k < kPairs; ++k) {
            const Found &a = found[std::size_t(k)], &b = found[std::size_t(k + kPairs)];
            if (a.found && b.found) {
                const float total = a.distance_px + b.distance_px;
                const float wa = b.distance_px / total, wb = a.distance_px / total;
                const float weight = (1 / a.distance_px + 1 / b.distance_px) * likeness(a, b);
                const bool one_surface = std::abs(a.coc_px - b.coc_px) < 2;
                if (one_surface) {
                    votes[std::size_t(n++)] = {wa * a.colour + wb * b.colour, wa * a.coc_px + wb * b.coc_px, weight};
                } else {
                    votes[std::size_t(n++)] = {a.colour, a.coc_px, weight / a.distance_px * total / 2};
                    votes[std::size_t(n++)] = {b.colour, b.coc_px, weight / b.distance_px * total / 2};
                }
            } else if (a.found || b.found) {
                const Found& one = a.found ? a : b;
                votes[std::size_t(n++)] = {one.colour, one.coc_px, 1 / (one.distance_px * one.distance_px)};
            }
        }
        float best = -1, chosen = 0;
        for (int i = 0; i < n; ++i) {
            float support = 0;
            for (int j = 0; j < n; ++j) {
                const float d = votes[std::size_t(i)].coc - votes[std::size_t(j)].coc;
                support += votes[std::size_t(j)].weight / (1 + d * d);
            }
            if (support > best) best = support, chosen = votes[std::size_t(i)].coc;
        }
        Rgba sum;
        float coc = 0, weight = 0;
        for (int i = 0; i < n; ++i) {
            const Vote& vote = votes[std::size_t(i)];
            const float d = vote.coc - chosen;
            const float w = vote.weight / (1 + d * d * d * d);
            sum += w * vote.colour, coc += w * vote.coc, weight += w;
        }
        return {sum * (1 / weight), coc / weight};
    }

    View<const Rgba> colour_;
    View<const float> coc_;
    View<const unsigned char> connected_;
    const Sparse<Mixture>& mixtures_;
    float farthest_ = -1e30f;
};

}  // namespace

Sparse<Hidden> fill_hidden(View<const Rgba> colour, View<const float> coc, View<const unsigned char> connected,
                           const Sparse<Mixture>& mixtures, int threads) {
    const Filler filler(colour, coc, connected, mixtures);
    std::vector<std::vector<Hidden>> rows(std::size_t(coc.height()), std::vector<Hidden>{});
    Sparse<Hidden> all{Image<int>(coc.width(), coc.height(), -1), {}};
    parallel_for(coc.height(), threads, [&](int y) {
        for (int x = 0; x < coc.width(); ++x) {
            Hidden hidden;
            if (mixtures.index(x, y) >= 0 || !filler.fill(x, y, hidden)) continue;
            all.index(x, y) = int(rows[std::size_t(y)].size());
            rows[std::size_t(y)].push_back(hidden);
        }
    });
    for (int y = 0; y < coc.height(); ++y) {
        const int before = int(all.values.size());
        for (int x = 0; x < coc.width(); ++x)
            if (all.index(x, y) >= 0) all.index(x, y) += before;
        all.values.insert(all.values.end(), rows[std::size_t(y)].begin(), rows[std::size_t(y)].end());
    }
    return all;
}

}  // namespace petzval::depth
