#include "base/parallel.h"
#include "depth/hidden.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::depth {
namespace {

constexpr int kDirections = 16;      // even: opposite directions are paired
constexpr float kBehindPx = 1.0f;    // farther by less than this in radius is not worth filling
constexpr float kPastEdgePx = 2.0f;  // how far beyond the reach of the blur to look
constexpr float kLikeEnough =
    0.1f;  // squared relative difference below which two patches are as good as the same
constexpr float kOneSided = 10;  // what a surface met on one side counts, against two unlike patches

// The end of a search: a few pixels of the surface that was met, as seen coming from the hidden pixel.
constexpr int kPatch = 5;
constexpr int kHits = 2;      // per direction
constexpr int kSurfaces = 3;  // behind one pixel
struct Found {
    bool found = false;
    std::array<Rgba, kPatch> patch;  // the pixel met, one to either side of it, two beyond it
    float coc_px = 0, distance_px = 0;
    const Rgba& colour() const { return patch[0]; }
};

constexpr int kBlock = 4;  // pixels on a side share one distance to the nearest silhouette

using Hits = std::array<std::array<Found, kHits>, kDirections>;

struct Direction {
    float x, y;
};
struct Step {
    float t;  // distance, px
    int x, y;
    std::ptrdiff_t offset;  // in the plane of clean radii
};
struct Path {
    Direction direction;
    std::vector<Step> steps;
};

class Filler {
public:
    Filler(View<const Rgba> colour, View<const float> coc, View<const unsigned char> connected,
           const Sparse<Mixture>& mixtures, float largest, float farthest)
        : colour_(colour),
          coc_(coc),
          connected_(connected),
          mixtures_(mixtures),
          farthest_(farthest),
          largest_(largest) {
        clean_ = Plane::uninitialised(coc.width(), coc.height());
        for (int y = 0; y < coc.height(); ++y)
            for (int x = 0; x < coc.width(); ++x)
                clean_(x, y) = mixtures.index(x, y) < 0 ? coc(x, y) : -1e30f;
        measure_distances();
        lay_paths();
    }

    // What lies behind (x, y), if any surface nearby does.
    bool fill(int x, int y, std::vector<Hidden>& hidden) const {
        const float own = coc_(x, y);
        if (beyond_(x / kBlock, y / kBlock) > std::abs(own) + kPastEdgePx) return false;
        Hits hits;
        bool any = false;
        const Slope slope = slope_at(coc_, connected_, x, y);
        for (int k = 0; k < kDirections; ++k) {
            hits[std::size_t(k)] = search(x, y, own, slope, paths_[std::size_t(k)]);
            any = any || hits[std::size_t(k)][0].found;
        }
        if (any) stack(hits, hidden);
        return any;
    }

private:
    // Per block of pixels: distance to each silhouette of a surface in the block, less the blur of what lies
    // behind it, the smallest. A two-sweep chamfer transform (G. Borgefors, "Distance transformations in
    // digital images", 1986) that does not enter surfaces as far as what it carries. Pixels beyond their own
    // blur need no search.
    void measure_distances() {
        const int width = (coc_.width() + kBlock - 1) / kBlock,
                  height = (coc_.height() + kBlock - 1) / kBlock;
        beyond_ = Plane(width, height, 1e9f);
        Plane far(width, height, -1e30f), nearest(width, height, 1e30f);
        for (int y = 0; y < coc_.height(); ++y)
            for (int x = 0; x < coc_.width(); ++x) {
                const int bx = x / kBlock, by = y / kBlock;
                nearest(bx, by) = std::min(nearest(bx, by), coc_(x, y));
                if (const Mixture* m = mixtures_.at(x, y); m && m->far_coc_px > far(bx, by))
                    beyond_(bx, by) = -std::abs(m->far_coc_px) - 2 * kBlock, far(bx, by) = m->far_coc_px;
            }
        constexpr float kSide = 0.955f * kBlock, kDiagonal = 1.3693f * kBlock;
        const auto relax = [&](int x, int y, int dx, int dy) {
            if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height) return;
            const float reached = beyond_(x + dx, y + dy) + (dx != 0 && dy != 0 ? kDiagonal : kSide);
            if (reached >= beyond_(x, y) || far(x + dx, y + dy) <= nearest(x, y) + kBehindPx) return;
            beyond_(x, y) = reached, far(x, y) = far(x + dx, y + dy);
        };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                relax(x, y, -1, 0), relax(x, y, -1, -1), relax(x, y, 0, -1), relax(x, y, 1, -1);
        for (int y = height - 1; y >= 0; --y)
            for (int x = width - 1; x >= 0; --x)
                relax(x, y, 1, 0), relax(x, y, 1, 1), relax(x, y, 0, 1), relax(x, y, -1, 1);
    }

    // Where the steps of each direction land: every pixel at first, every sixteenth of the way further out.
    void lay_paths() {
        const float longest = largest_ + std::abs(farthest_) + kPastEdgePx;
        for (int k = 0; k < kDirections; ++k) {
            const double angle = 2 * M_PI * (k + 0.5) / kDirections;
            Path& path = paths_[std::size_t(k)];
            path.direction = {float(std::cos(angle)), float(std::sin(angle))};
            for (float t = 1; t <= longest; t += t < 16 ? 1.0f : t / 16) {
                const int dx = int(std::lround(t * path.direction.x)),
                          dy = int(std::lround(t * path.direction.y));
                path.steps.push_back({t, dx, dy, std::ptrdiff_t(dy) * clean_.width() + dx});
            }
        }
    }

    // The first clean pixel of a farther surface, walking from (x, y), and of one farther still.
    std::array<Found, kHits> search(int x, int y, float own, Slope slope, const Path& path) const {
        const Direction d = path.direction;
        const float longest = std::abs(own) + std::abs(farthest_) + kPastEdgePx;
        const float own_per_px = std::max(0.0f, slope.x * d.x + slope.y * d.y);
        const float* const start = &clean_(x, y);
        std::array<Found, kHits> hits;
        int n = 0;
        float behind = own + kBehindPx;
        for (const Step& step : path.steps) {
            if (step.t > longest || n == kHits) break;
            const int u = x + step.x, v = y + step.y;
            if (u < 0 || v < 0 || u >= clean_.width() || v >= clean_.height()) break;
            const float c = start[step.offset];
            if (c <= behind || c <= own + step.t * own_per_px + kBehindPx) continue;
            if (step.t <= std::abs(own) + std::abs(c) + kPastEdgePx)
                hits[std::size_t(n++)] = {true, patch_at(u, v, c, d), c, step.t};
            behind = c + 2 * kBehindPx;
        }
        return hits;
    }

    std::array<Rgba, kPatch> patch_at(int x, int y, float c, Direction d) const {
        // Across the direction in a fixed sense, so that patches met in opposite directions can be compared.
        const bool turned = d.y < 0 || (d.y == 0 && d.x < 0);
        const float across_x = turned ? d.y : -d.y, across_y = turned ? -d.x : d.x;
        const std::array<Direction, kPatch> offsets{{{0, 0},
                                                     {1.5f * across_x, 1.5f * across_y},
                                                     {-1.5f * across_x, -1.5f * across_y},
                                                     {1.5f * d.x, 1.5f * d.y},
                                                     {3 * d.x, 3 * d.y}}};
        std::array<Rgba, kPatch> patch;
        for (int k = 0; k < kPatch; ++k) {
            const Direction o = offsets[std::size_t(k)];
            const int u = x + int(std::lround(o.x)), v = y + int(std::lround(o.y));
            const bool usable =
                coc_.rect().contains(u, v) && mixtures_.index(u, v) < 0 && std::abs(coc_(u, v) - c) < 1;
            patch[std::size_t(k)] = usable ? colour_(u, v) : colour_(x, y);
        }
        return patch;
    }

    // High where two patches could be two pieces of one surface.
    static float likeness(const Found& a, const Found& b) {
        float difference = 0, level = 0;
        for (int k = 0; k < kPatch; ++k) {
            const Rgba d = a.patch[std::size_t(k)] - b.patch[std::size_t(k)];
            const Rgba m = 0.5f * (a.patch[std::size_t(k)] + b.patch[std::size_t(k)]);
            difference += d.r * d.r + d.g * d.g + d.b * d.b;
            level += m.r * m.r + m.g * m.g + m.b * m.b;
        }
        const float depth = a.coc_px - b.coc_px;
        const float unlike = difference / (level + 0.003f) + 0.02f * depth * depth;
        return 1 / (kLikeEnough + unlike * unlike);
    }

    static bool one_surface(float coc_a, float coc_b) {
        return std::abs(coc_a - coc_b) < 1.5f + 0.05f * std::abs(coc_a + coc_b);
    }

    // A surface mostly there is wholly there, one hardly there is not: smoothstep around one half.
    static float sharpened(float share) {
        const float t = std::clamp((share - 0.3f) / 0.4f, 0.0f, 1.0f);
        return t * t * (3 - 2 * t);
    }

    // The surfaces that were met, nearest first. The farthest fills all there is; a nearer one only the share
    // of the surroundings that it has: a wire behind a leaf goes on as a wire.
    static void stack(Hits& hits, std::vector<Hidden>& hidden) {
        float share_behind = 0;
        std::array<Hidden, kSurfaces> surfaces{};
        int n = 0;
        for (; n < kSurfaces; ++n) {
            // The farthest that is left, and all that belongs to it.
            float farthest = -1e30f;
            for (const auto& direction : hits)
                for (const Found& f : direction)
                    if (f.found) farthest = std::max(farthest, f.coc_px);
            if (farthest < -1e29f) break;
            float share = 0;
            surfaces[std::size_t(n)] = surface(hits, farthest, share);
            share_behind += share;
            surfaces[std::size_t(n)].share = sharpened(share / share_behind);
            surfaces[std::size_t(n)].colour *= surfaces[std::size_t(n)].share;
        }
        for (int i = n - 1; i >= 0; --i) hidden.push_back(surfaces[std::size_t(i)]);
    }

    // What the hits at `coc_px` agree on; they are used up. share: their weight, the sum of 1/distance.
    static Hidden surface(Hits& hits, float coc_px, float& share) {
        Rgba sum;
        float coc = 0, weight_sum = 0;
        const auto vote = [&](Rgba colour, float c, float weight) {
            sum += weight * colour, coc += weight * c, weight_sum += weight;
        };
        const auto take = [&](int k) -> Found* {
            for (Found& f : hits[std::size_t(k)])
                if (f.found && one_surface(f.coc_px, coc_px)) return &f;
            return nullptr;
        };
        constexpr int kPairs = kDirections / 2;
        for (int k = 0; k < kPairs; ++k) {
            Found *a = take(k), *b = take(k + kPairs);
            // Seen on both sides, it most likely goes on between them.
            if (a && b) share += 2 / a->distance_px + 2 / b->distance_px;
            if (!a != !b) share += 0.5f / (a ? a : b)->distance_px;
            if (a && b) {
                const float total = a->distance_px + b->distance_px;
                const float wa = b->distance_px / total, wb = a->distance_px / total;
                vote(wa * a->colour() + wb * b->colour(), wa * a->coc_px + wb * b->coc_px,
                     (1 / a->distance_px + 1 / b->distance_px) * likeness(*a, *b));
            } else if (a || b) {
                const Found& one = a ? *a : *b;
                vote(one.colour(), one.coc_px, kOneSided / (one.distance_px * one.distance_px));
            }
            if (a) a->found = false;
            if (b) b->found = false;
        }
        return {sum * (1 / weight_sum), coc / weight_sum, 1};
    }

    View<const Rgba> colour_;
    View<const float> coc_;
    View<const unsigned char> connected_;
    const Sparse<Mixture>& mixtures_;
    Plane clean_;   // radius of pixels that touch no silhouette, else far in front
    Plane beyond_;  // see measure_distances
    std::array<Path, kDirections> paths_;
    float farthest_, largest_;  // of the frame: radius farthest behind, largest |radius|
};

// Where blurs are wide, what is hidden is seen only through them: pixels of one surface then share what is
// found for the first of them in a square of so many.
int sharing_step(float widest_blur_px) { return widest_blur_px < 40 ? 1 : widest_blur_px < 120 ? 2 : 4; }

}  // namespace

HiddenLayers fill_hidden(View<const Rgba> colour, View<const float> coc, View<const unsigned char> connected,
                         const Sparse<Mixture>& mixtures, float nearest_coc_px, float farthest_coc_px,
                         int threads) {
    const int width = coc.width(), height = coc.height();
    HiddenLayers layers;
    if (mixtures.values.empty()) return layers;
    const float largest = std::max(std::abs(nearest_coc_px), std::abs(farthest_coc_px));
    const Filler filler(colour, coc, connected, mixtures, largest, farthest_coc_px);
    const int step = sharing_step(std::abs(nearest_coc_px) + std::abs(farthest_coc_px));
    const int bands = (height + step - 1) / step;
    struct Range {
        int begin, end;
    };
    std::vector<std::vector<Hidden>> found(static_cast<std::size_t>(bands));
    Image<Range> ranges(width, height, Range{0, 0});  // of each pixel, in its band
    parallel_for(bands, threads, [&](int band) {
        std::vector<Hidden>& here = found[std::size_t(band)];
        const int y0 = band * step, y1 = std::min(height, y0 + step);
        for (int x0 = 0; x0 < width; x0 += step) {
            const int x1 = std::min(width, x0 + step);
            float surface = 1e30f;  // radius of the surface that was asked for last
            Range range{0, 0};
            for (int y = y0; y < y1; ++y)
                for (int x = x0; x < x1; ++x) {
                    if (mixtures.index(x, y) >= 0) continue;
                    if (std::abs(coc(x, y) - surface) > kBehindPx / 2) {
                        surface = coc(x, y);
                        range.begin = int(here.size());
                        filler.fill(x, y, here);
                        range.end = int(here.size());
                    }
                    ranges(x, y) = range;
                }
        }
    });
    std::vector<std::size_t> starts;
    for (const auto& band : found) {
        starts.push_back(layers.samples.size());
        layers.samples.insert(layers.samples.end(), band.begin(), band.end());
    }
    layers.ranges = Image<HiddenLayers::Range>::uninitialised(width, height);
    parallel_for(height, threads, [&](int y) {
        const std::size_t start = starts[std::size_t(y / step)];
        for (int x = 0; x < width; ++x) {
            const Range r = ranges(x, y);
            layers.ranges(x, y) = {std::uint32_t(start + std::size_t(r.begin)),
                                   std::uint32_t(r.end - r.begin)};
        }
    });
    return layers;
}

}  // namespace petzval::depth
