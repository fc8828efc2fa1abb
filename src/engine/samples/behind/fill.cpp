#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"
#include "engine/samples/known_surfaces.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/outlines/hidden_outlines.h"
#include "engine/samples/textures/hidden_textures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kDirections = 16;  // even: opposite directions are paired

float square(Rgba c) { return c.r * c.r + c.g * c.g + c.b * c.b; }

// The end of a search: a pixel of the surface that was met.
constexpr int kHits = 2;  // per direction
constexpr int kSurfaces = HiddenLayers::kMost;
struct Found {
    bool found = false;
    int x = 0, y = 0;
    float coc_px = 0, distance_px = 0;
    KnownSurfaces::Place place() const { return {x, y, coc_px}; }
};
// A few pixels around it, as seen coming from the hidden pixel: itself, one to either side, two beyond.
constexpr int kPatch = 5;
using Patch = std::array<Rgba, kPatch>;

constexpr int kBlock = 4;  // pixels on a side share one distance to the nearest silhouette

using Hits = std::array<std::array<Found, kHits>, kDirections>;

struct Step {
    float t;  // distance, px
    int x, y;
    std::ptrdiff_t offset;  // in the plane of clean radii
};
struct Path {
    Direction direction;
    std::vector<Step> steps;
    std::vector<std::size_t> at_distance;  // the first step at least so many pixels away
};

// Weighted votes on the colour of a hidden surface.
class Votes {
public:
    void add(Rgba colour, float coc_px, float weight) {
        const float light = std::max(0.0f, luminance(colour));
        votes_[std::size_t(count_++)] = {colour, coc_px, weight, light};
        roots_ += weight * std::sqrt(light), weight_ += weight;
    }
    // Their mean; but a lamp that few see does not shine all over a surface.
    Hidden result() const {
        const float usual = completion_model.usual_contrast * (roots_ / weight_) * (roots_ / weight_) + 1e-6f;
        Rgba sum;
        float coc = 0, total = 0;
        for (const Vote& vote : std::span(votes_).first(std::size_t(count_))) {
            const float excess = vote.light / usual;
            const float weight = vote.weight / (1 + excess * excess);
            sum += weight * vote.colour, coc += weight * vote.coc_px, total += weight;
        }
        return {sum * (1 / total), coc / total, 1};
    }

private:
    struct Vote {
        Rgba colour;
        float coc_px, weight, light;
    };
    std::array<Vote, kDirections + kDirections / 2> votes_;
    int count_ = 0;
    float roots_ = 0, weight_ = 0;
};

class Filler {
public:
    Filler(const LitPicture& picture, View<const float> coc, View<const unsigned char> connected,
           const Mixtures& mixtures, float largest, float farthest, const FillRule& rule, float white,
           Workers& workers)
        : known_(picture, coc, mixtures, white, workers, rule.edges_to_px),
          outlines_(coc, workers),
          textures_(known_, mixtures, rule.textures ? largest : 0, workers),
          coc_(coc),
          connected_(connected),
          mixtures_(mixtures),
          farthest_(farthest),
          largest_(largest),
          every_(std::size_t(kDirections / rule.directions)),
          every_blurred_(std::size_t(kDirections / rule.blurred_directions)) {
        measure_distances(workers);
        lay_paths();
    }

    // True if a lens ray can pass the occluder and reach the surface behind (x, y).
    bool may_hide(int x, int y) const {
        return beyond_(x / kBlock, y / kBlock) <= std::abs(coc_(x, y)) + completion_model.past_edge_px;
    }
    // Appends what lies behind (x, y), if any surface nearby does.
    void fill(int x, int y, std::vector<Hidden>& hidden) const {
        const Mixture* m = mixtures_.at(x, y);
        const float own = m ? m->near_coc_px : coc_(x, y);
        Hits hits;
        bool any = false;
        const Slope slope = slope_at(coc_, connected_, x, y);
        bool sharp = false;
        const auto look = [&](std::size_t k) {
            hits[k] = search(x, y, own, slope, paths_[k]);
            any = any || hits[k][0].found;
            for (const Found& f : hits[k])
                sharp = sharp || (f.found && std::abs(f.coc_px) < completion_model.texture_sharp_px);
        };
        for (std::size_t k = 0; k < kDirections; k += every_blurred_) look(k);
        if (sharp || !any)
            for (std::size_t k = 0; k < kDirections; k += every_)
                if (k % every_blurred_ != 0) look(k);
        if (any) stack(x, y, hits, hidden);
    }

private:
    // Per block of pixels: the smallest distance to a silhouette of a surface in the block, less the blur of
    // the surface behind it. A two-sweep chamfer transform (G. Borgefors, "Distance transformations in
    // digital images", 1986) that does not enter surfaces as far as the surface that it carries. Pixels
    // beyond their own blur need no search.
    void measure_distances(Workers& workers) {
        const int width = (coc_.width() + kBlock - 1) / kBlock,
                  height = (coc_.height() + kBlock - 1) / kBlock;
        beyond_ = Plane(width, height, 1e9f);
        blocks_ = Image<Block>(width, height);
        Plane far(width, height, -1e30f), nearest(width, height, 1e30f);
        parallel_for(height, workers, [&](int by) {
            for (int y = by * kBlock; y < std::min((by + 1) * kBlock, coc_.height()); ++y)
                for (int x = 0; x < coc_.width(); ++x) {
                    const int bx = x / kBlock;
                    nearest(bx, by) = std::min(nearest(bx, by), coc_(x, y));
                    Block& block = blocks_(bx, by);
                    block.farthest = std::max(block.farthest, known_.radii()(x, y));
                    const Mixture* m = mixtures_.at(x, y);
                    if (!m) continue;
                    block.free = -kBlock;
                    if (m->far_coc_px > far(bx, by))
                        beyond_(bx, by) = -std::abs(m->far_coc_px) - 2 * kBlock, far(bx, by) = m->far_coc_px;
                }
        });
        constexpr float kSide = 0.955f * kBlock, kDiagonal = 1.3693f * kBlock;
        const auto relax = [&](int x, int y, int dx, int dy) {
            if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height) return;
            blocks_(x, y).free = std::min(blocks_(x, y).free, blocks_(x + dx, y + dy).free + kBlock);
            const float reached = beyond_(x + dx, y + dy) + (dx != 0 && dy != 0 ? kDiagonal : kSide);
            if (reached >= beyond_(x, y) || far(x + dx, y + dy) <= nearest(x, y) + completion_model.step_px)
                return;
            beyond_(x, y) = reached, far(x, y) = far(x + dx, y + dy);
        };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                relax(x, y, -1, 0), relax(x, y, -1, -1), relax(x, y, 0, -1), relax(x, y, 1, -1);
        for (int y = height - 1; y >= 0; --y)
            for (int x = width - 1; x >= 0; --x)
                relax(x, y, 1, 0), relax(x, y, 1, 1), relax(x, y, 0, 1), relax(x, y, -1, 1);
    }

    // Pixels visited in each direction: every pixel at first, every eighth of the way further out.
    void lay_paths() {
        const float longest = largest_ + std::abs(farthest_) + completion_model.past_edge_px;
        for (int k = 0; k < kDirections; ++k) {
            const double angle = 2 * M_PI * k / kDirections;
            Path& path = paths_[std::size_t(k)];
            path.direction = {float(std::cos(angle)), float(std::sin(angle))};
            for (float t = 1; t <= longest; t += std::max(1.0f, t / 8)) {
                const int dx = nearest_pixel(t * path.direction.x), dy = nearest_pixel(t * path.direction.y);
                path.steps.push_back({t, dx, dy, std::ptrdiff_t(dy) * coc_.width() + dx});
            }
            for (std::size_t i = 0; i < path.steps.size(); ++i)
                while (float(path.at_distance.size()) <= path.steps[i].t) path.at_distance.push_back(i);
        }
    }

    // The first clean pixel of a farther surface, walking from (x, y), and of one farther still.
    std::array<Found, kHits> search(int x, int y, float own, Slope slope, const Path& path) const {
        const float own_per_px = std::max(0.0f, slope.x * path.direction.x + slope.y * path.direction.y);
        float longest = std::abs(own) + std::abs(farthest_) + completion_model.past_edge_px;
        const float* const start = &known_.radii()(x, y);
        std::array<Found, kHits> hits;
        std::size_t n = 0;
        float behind = own + completion_model.step_px;
        const unsigned width = unsigned(coc_.width()), height = unsigned(coc_.height());
        const Step *step = path.steps.data(), *const end = step + path.steps.size();
        while (step != end && step->t <= longest) {
            const unsigned u = unsigned(x + step->x), v = unsigned(y + step->y);
            if (u >= width || v >= height) break;
            const Block& block = blocks_(int(u / unsigned(kBlock)), int(v / unsigned(kBlock)));
            // (Of a block all of which lies in front, no pixel is looked at: their plane fills no cache.)
            const float c = block.farthest > behind ? start[step->offset] : behind;
            if (c > behind && c > own + step->t * own_per_px + completion_model.step_px) {
                if (step->t <= std::abs(own) + std::abs(c) + completion_model.past_edge_px) {
                    hits[n++] = {true, int(u), int(v), c, step->t};
                    longest = std::min(
                        longest, completion_model.search_factor * step->t + completion_model.search_more_px);
                }
                behind = c + 2 * completion_model.step_px;
                if (n == kHits || behind >= farthest_) break;
            }
            // No other surface comes before the next silhouette.
            if (block.free <= 1) {
                ++step;
                continue;
            }
            const std::size_t distance = std::size_t(step->t) + std::size_t(block.free);
            if (distance >= path.at_distance.size()) break;
            step = std::max(step + 1, path.steps.data() + path.at_distance[distance]);
        }
        return hits;
    }

    Patch patch_at(const Found& hit, Direction d) const {
        const float near = completion_model.patch_near_px, far = completion_model.patch_far_px;
        const int x = hit.x, y = hit.y;
        // Across the direction in a fixed sense, so that patches met in opposite directions can be compared.
        const bool turned = d.y < 0 || (d.y == 0 && d.x < 0);
        const float across_x = turned ? d.y : -d.y, across_y = turned ? -d.x : d.x;
        const std::array<Direction, kPatch> offsets{{{0, 0},
                                                     {near * across_x, near * across_y},
                                                     {-near * across_x, -near * across_y},
                                                     {near * d.x, near * d.y},
                                                     {far * d.x, far * d.y}}};
        Patch patch;
        for (int k = 0; k < kPatch; ++k) {
            const Direction o = offsets[std::size_t(k)];
            const int u = x + nearest_pixel(o.x), v = y + nearest_pixel(o.y);
            const bool usable = known_.shows(u, v, hit.coc_px);
            patch[std::size_t(k)] = comparable(usable ? known_.colour(u, v) : known_.colour(x, y));
        }
        return patch;
    }

    // High where two patches could be two pieces of one surface, and higher where an edge runs from one to
    // the other: plain patches look alike everywhere.
    float likeness(const Found& a, Direction to_a, const Found& b, Direction to_b) const {
        const Patch at_a = patch_at(a, to_a), at_b = patch_at(b, to_b);
        const CompletionModel& model = completion_model;
        float difference = 0, level = model.patch_level;
        for (std::size_t k = 0; k < kPatch; ++k) {
            difference += square(at_a[k] - at_b[k]);
            level += square(0.5f * (at_a[k] + at_b[k]));
        }
        const float depth = a.coc_px - b.coc_px;
        const float unlike = difference / level + model.patch_depth * depth * depth;
        const auto across = [](const Patch& p) { return square(p[0] - p[1]) + square(p[0] - p[2]); };
        const auto along = [](const Patch& p) { return square(p[0] - p[3]) + square(p[0] - p[4]); };
        const float plain = model.patch_plain * level;
        const float edge = (plain + across(at_a) + across(at_b)) / (plain + along(at_a) + along(at_b));
        return edge / (model.patch_alike + unlike * unlike);
    }

    // A surface mostly there is wholly there, one hardly there is not: smoothstep around one half.
    static float sharpened(float share) {
        const float t =
            std::clamp((share - completion_model.share_least) / completion_model.share_range, 0.0f, 1.0f);
        return t * t * (3 - 2 * t);
    }

    // Weight of one surface among those met, by 1/distance.
    struct Met {
        float all = 0, within = 0;  // its own outline
        float unhidden = 0;         // by outlines of nearer ones
    };

    // The surfaces met, nearest first. The farthest fills the rest; a nearer one takes the share that it has
    // of the surroundings, so a wire behind a leaf continues as a wire. Where its outline continues hidden,
    // it takes all on its side.
    void stack(int x, int y, Hits& hits, std::vector<Hidden>& hidden) const {
        float all_behind = 0, unhidden_behind = 0;
        std::array<Hidden, kSurfaces> surfaces{};
        int n = 0;
        for (; n < kSurfaces; ++n) {
            // The farthest that is left, and all that belongs to it.
            float farthest = -1e30f;
            for (const auto& direction : hits)
                for (const Found& f : direction)
                    if (f.found) farthest = std::max(farthest, f.coc_px);
            if (farthest < -1e29f) break;
            Met met;
            surfaces[std::size_t(n)] = surface(x, y, hits, farthest, met);
            const float inside = met.within / met.all;
            const float behind = all_behind + inside * (unhidden_behind - all_behind);
            const float share = n == 0 ? 1 : sharpened(met.within / (met.within + behind + 1e-9f));
            all_behind += met.within, unhidden_behind += met.unhidden * inside;
            surfaces[std::size_t(n)].share = share;
            surfaces[std::size_t(n)].colour *= share;
        }
        for (int i = n - 1; i >= 0; --i) hidden.push_back(surfaces[std::size_t(i)]);
    }

    // Radius of the nearest hit on the surface whose farthest hit is at farthest_px. A sloping floor is hit
    // at many radii, in small steps: it is one surface.
    static float nearest_of_surface(const Hits& hits, float farthest_px) {
        float nearest = farthest_px;
        for (float before = farthest_px, step = 1; nearest < before || step == 1; step = 0.5f) {
            before = nearest;
            for (const auto& direction : hits)
                for (const Found& f : direction)
                    if (f.found && before - f.coc_px < step * surface_step_px(f.coc_px, before))
                        nearest = std::min(nearest, f.coc_px);
        }
        return nearest;
    }

    // The estimate of the surface behind (x, y) whose farthest hit is at `coc_px`. Its hits are used up.
    Hidden surface(int x, int y, Hits& hits, float coc_px, Met& met) const {
        Votes votes;
        HiddenTextures::Point hidden(textures_, x, y);
        const float nearest_px = nearest_of_surface(hits, coc_px);
        const auto take = [&](std::size_t k) -> const Found* {
            for (const Found& f : hits[k])
                if (f.found && f.coc_px >= nearest_px) return &f;
            return nullptr;
        };
        const auto passes = [&](const Found* f) { return f ? known_.passes(f->place(), x, y) : 0; };
        const auto meet = [&](const Found& f, float weight) {
            const float share = weight / f.distance_px;
            met.all += share;
            const HiddenOutlines::Open open = outlines_.open({f.x, f.y}, {x, y}, f.coc_px);
            met.within += share * open.within, met.unhidden += share * open.unhidden;
        };
        float nearest = 1e9f;  // distance, px
        for (std::size_t k = 0; k < kDirections; ++k)
            if (const Found* f = take(k)) nearest = std::min(nearest, f->distance_px);
        constexpr std::size_t kPairs = kDirections / 2;
        for (std::size_t k = 0; k < kPairs; ++k) {
            const Found *a = take(k), *b = take(k + kPairs);
            // A surface seen on both sides most likely continues between them, unless an edge cuts one side
            // off.
            const float weight = a && b ? completion_model.share_pair : completion_model.share_alone;
            if (a) meet(*a, weight);
            if (b) meet(*b, weight);
            const float from_a = passes(a), from_b = passes(b), both = from_a * from_b;
            if (a && b) add_pair(hidden, *a, *b, k, both, votes);
            if (a && from_a > both) add_alone(hidden, *a, k, nearest, from_a - both, votes);
            if (b && from_b > both) add_alone(hidden, *b, k + kPairs, nearest, from_b - both, votes);
        }
        for (auto& direction : hits)
            for (Found& f : direction) f.found = f.found && f.coc_px < nearest_px;
        return votes.result();
    }
    // Adds the surfaces met in direction k and the opposite one.
    void add_pair(HiddenTextures::Point& hidden, const Found& a, const Found& b, std::size_t k, float weight,
                  Votes& votes) const {
        const float total = a.distance_px + b.distance_px;
        const float wa = b.distance_px / total, wb = a.distance_px / total;
        const float alike = likeness(a, paths_[k].direction, b, paths_[k + kDirections / 2].direction);
        const float closeness = 1 / a.distance_px + 1 / b.distance_px;
        const auto colour = [&](const Found& f) {
            return hidden.going_on(f.place(), known_.colour(f.x, f.y));
        };
        votes.add(wa * colour(a) + wb * colour(b), wa * a.coc_px + wb * b.coc_px,
                  weight * (closeness * std::sqrt(closeness) * alike));
    }
    // Adds a surface met in direction k alone.
    void add_alone(HiddenTextures::Point& hidden, const Found& one, std::size_t k, float nearest_px,
                   float weight, Votes& votes) const {
        const float away = one.distance_px * one.distance_px;
        const Rgba colour = known_.going_on(one.place(), paths_[k].direction, one.distance_px);
        votes.add(hidden.going_on(one.place(), colour), one.coc_px,
                  weight * (completion_model.alone_weight * nearest_px / (away * one.distance_px)));
    }

    KnownSurfaces known_;
    HiddenOutlines outlines_;
    HiddenTextures textures_;
    View<const float> coc_;
    View<const unsigned char> connected_;
    const Mixtures& mixtures_;
    Plane beyond_;  // see measure_distances
    struct Block {
        float farthest = -1e30f;  // known radius in it
        int free = 1 << 20;       // pixels one can go from anywhere in it without meeting a silhouette
    };
    Image<Block> blocks_;
    std::array<Path, kDirections> paths_;
    float farthest_, largest_;  // of the frame: radius farthest behind, largest |radius|
    // Every how many directions are searched; the second number applies where no sharp surface is met.
    std::size_t every_, every_blurred_;
};

constexpr int kLargestSquare = HiddenLayers::kBand;

// Hidden surfaces are seen through their own blur, so pixels of one surface share the answer of the first
// pixel in a square. Returns the side of that square, pixels.
int shared_square(std::span<const Hidden> hidden, float shared_from_px) {
    float least_blur_px = 1e30f;
    for (const Hidden& h : hidden) least_blur_px = std::min(least_blur_px, std::abs(h.coc_px));
    const float blur = least_blur_px / shared_from_px;
    return blur < 1 ? 1 : blur < 2 ? 2 : blur < 6 ? 4 : kLargestSquare;
}

using Range = HiddenLayers::Range;

Range range(std::size_t begin, std::size_t end) {
    Range r{};
    r.begin = begin & ((1U << 30) - 1), r.count = (end - begin) & HiddenLayers::kMost;
    return r;
}

// Answers found in a square of kLargestSquare pixels so far.
class Answers {
public:
    void clear() { answers_.clear(); }
    const Range* find(int x, int y, float surface_px) const {
        for (const Answer& a : answers_)
            if (((x ^ a.x) | (y ^ a.y)) < a.square &&  // squares are powers of two
                std::abs(a.surface_px - surface_px) <= completion_model.step_px / 2)
                return &a.range;
        return nullptr;
    }
    void add(int x, int y, float surface_px, int square, Range range) {
        answers_.push_back({x, y, square, surface_px, range});
    }

private:
    struct Answer {
        int x, y, square;
        float surface_px;
        Range range;
    };
    std::vector<Answer> answers_;
};

// Rows of the picture that are filled one square after the other.
struct Band {
    const Filler& filler;
    const Mixtures& mixtures;
    View<const float> coc;
    Rect rows;
    float shared_from_px;
    Image<Range> ranges;  // of its pixels in `hidden`
    std::vector<Hidden> hidden;
    Answers answers;

    void fill_square(const Rect& square) {
        answers.clear();
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0; x < square.x1; ++x) {
                const Mixture* m = mixtures.at(x, y);
                if (m ? m->shows_far : !filler.may_hide(x, y)) continue;
                Range& own = ranges(x, y - rows.y0);
                if (const Range* known = answers.find(x, y, coc(x, y))) {
                    own = *known;
                    continue;
                }
                const std::size_t begin = hidden.size();
                filler.fill(x, y, hidden);
                own = range(begin, hidden.size());
                if (own.count == 0) continue;  // its neighbours may lie closer to the silhouette
                answers.add(x, y, coc(x, y), shared_square(std::span(hidden).subspan(begin), shared_from_px),
                            own);
            }
    }
};

}  // namespace

HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, Workers& workers) {
    return fill_hidden(picture, coc, connected, mixtures, nearest_coc_px, farthest_coc_px, rule, 0, workers);
}

HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, float white, Workers& workers) {
    const int width = coc.width(), height = coc.height();
    HiddenLayers layers;
    if (mixtures.empty()) return layers;
    const float largest = std::max(std::abs(nearest_coc_px), std::abs(farthest_coc_px));
    const Filler filler(picture, coc, connected, mixtures, largest, farthest_coc_px, rule, white, workers);
    const int bands = (height + kLargestSquare - 1) / kLargestSquare;
    layers.bands.resize(std::size_t(bands));
    layers.ranges = {width, height};
    parallel_for(bands, workers, [&](int i) {
        const Rect rows =
            Rect{0, i * kLargestSquare, width, (i + 1) * kLargestSquare}.intersected(coc.rect());
        Band band{filler, mixtures, coc, rows, rule.shared_from_px, Image<Range>(width, rows.height()),
                  {},     {}};
        for (int x = 0; x < width; x += kLargestSquare)
            band.fill_square(Rect{x, rows.y0, x + kLargestSquare, rows.y1}.intersected(rows));
        for (int y = rows.y0; y < rows.y1; ++y)
            layers.ranges.find_row(y, [&](const auto& emit) {
                for (int x = 0; x < width; ++x)
                    if (const Range r = band.ranges(x, y - rows.y0); r.count > 0) emit(x, r);
            });
        layers.bands[std::size_t(i)].assign(band.hidden.begin(), band.hidden.end());  // no more room
    });
    return layers;
}

}  // namespace petzval::engine
