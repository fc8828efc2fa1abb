#include "base/parallel.h"
#include "engine/samples/behind/beside.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/near_silhouettes.h"
#include "engine/samples/behind/search.h"
#include "engine/samples/behind/smooth.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/outlines/hidden_outlines.h"
#include "engine/samples/textures/hidden_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace petzval::engine {
namespace {

// All directions are searched so close to a hidden outline: the share of its surface depends on them.
constexpr float kCloseToOutlinePx = 4;
constexpr std::size_t kSurfaces = HiddenLayers::kMost;

float square(Rgba c) { return c.r * c.r + c.g * c.g + c.b * c.b; }

// A few pixels around the end of a search, as seen coming from the hidden pixel: itself, one to either side,
// two beyond.
constexpr int kPatch = 5;
using Patch = std::array<Rgba, kPatch>;

// Weighted votes on the colour of a hidden surface.
class Votes {
public:
    // A colour. A texture states a share of it.
    void add(Rgba colour, const HiddenTextures::Point::Told& told, float weight) {
        const float plain = weight * (1 - told.share);
        colour_ += plain * colour, plain_ += plain, texture_ += weight * told.colour;
    }
    void add(float coc_px, float weight) { coc_ += weight * coc_px, total_ += weight; }
    HiddenGuess mean() const {
        HiddenGuess guess{{{}, coc_ / total_, 1}, texture_ * (1 / total_), plain_ / total_, 0};
        if (plain_ > 0) guess.seen.colour = colour_ * (1 / plain_);
        return guess;
    }

private:
    Rgba colour_, texture_;
    float plain_ = 0, coc_ = 0, total_ = 0;
};

class Filler {
public:
    Filler(const LitPicture& picture, View<const float> coc, View<const unsigned char> connected,
           const Mixtures& mixtures, float nearest, float farthest, const FillRule& rule, float white,
           Workers& workers)
        : known_(picture, coc, mixtures, white, workers, rule.edges_to_px),
          outlines_(coc, workers),
          textures_(known_, mixtures, rule.textures ? std::max(-nearest, farthest) : 0, workers),
          coc_(coc),
          connected_(connected),
          mixtures_(mixtures),
          near_silhouettes_(coc, mixtures, workers),
          search_(known_, coc, mixtures, nearest, farthest, workers),
          every_(std::size_t(kDirections / rule.directions)),
          every_first_(std::size_t(kDirections / rule.first_directions)) {}

    const KnownSurfaces& known() const { return known_; }
    bool may_hide(int x, int y) const { return near_silhouettes_.may_hide(x, y, coc_(x, y)); }

    std::optional<HiddenGuess> beside(int x, int y) const { return surface_beside(known_, coc_, x, y); }
    // Appends the surfaces behind (x, y), if a lens ray that passes the occluder reaches any of them.
    void fill(int x, int y, std::vector<HiddenGuess>& hidden) const {
        const Mixture* m = mixtures_.at(x, y);
        const float own = m && !m->shows_far ? m->near_coc_px : coc_(x, y);
        Hits hits;
        const HiddenOutlines::Around outlines = outlines_.around({x, y});
        const float outline_px = outlines.distance_px();
        const SurfaceSearch::Start start{x, y, own, slope_at(coc_, connected_, x, y),
                                         std::isfinite(outline_px) ? completion_model.outline_search_px : 0};
        bool reached = false;
        const auto look = [&](std::size_t k) {
            hits[k] = search_.look(start, k);
            for (const Found& f : hits[k])
                reached = reached || (f.found && f.distance_px <= SurfaceSearch::reach_px(own, f.coc_px));
        };
        for (std::size_t k = 0; k < kDirections; k += every_first_) look(k);
        if (!reached || outline_px < kCloseToOutlinePx)
            for (std::size_t k = 0; k < kDirections; k += every_)
                if (k % every_first_ != 0) look(k);
        if (reached) stack({x, y, outlines, known_.edges_around(x, y)}, hits, hidden);
    }

private:
    Patch patch_at(const Found& hit, Direction d) const {
        const float near = completion_model.patch_near_px, far = 2 * near;
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
        float difference = 0, level = 1e-6f;  // two black patches are alike
        for (std::size_t k = 0; k < kPatch; ++k) {
            difference += square(at_a[k] - at_b[k]);
            level += square(0.5f * (at_a[k] + at_b[k]));
        }
        const float unlike = difference / level;
        const auto across = [](const Patch& p) { return square(p[0] - p[1]) + square(p[0] - p[2]); };
        const auto along = [](const Patch& p) { return square(p[0] - p[3]) + square(p[0] - p[4]); };
        const float plain = model.patch_alike * level;
        const float edge = (plain + across(at_a) + across(at_b)) / (plain + along(at_a) + along(at_b));
        return edge / (model.patch_alike + unlike * unlike);
    }

    // Rounds a share: a surface with most of the surroundings gets nearly all, one with little nearly
    // nothing. Smoothstep around one half.
    static float sharpened(float share) {
        const float least = completion_model.share_least;
        const float t = std::clamp((share - least) / (1 - 2 * least), 0.0f, 1.0f);
        return t * t * (3 - 2 * t);
    }

    // A surface met by the search, with weights by 1/distance.
    struct Met {
        float all = 0, within = 0;  // weight of all hits, and of those inside the surface's own outline
        float unhidden = 0;         // weight of hits that no outline of a nearer surface hides
    };

    // A hidden pixel, and the outlines and edges around it.
    struct Here {
        int x, y;
        const HiddenOutlines::Around& outlines;
        CutEdges::Around edges;
    };

    // The surfaces met, nearest first. The farthest fills the rest; a nearer one takes the share that it has
    // of the surroundings, so a wire behind a leaf continues as a wire. Where its outline continues hidden,
    // it takes all on its side.
    void stack(const Here& here, Hits& hits, std::vector<HiddenGuess>& hidden) const {
        float all_behind = 0, unhidden_behind = 0;
        std::array<HiddenGuess, kSurfaces + 1> surfaces;
        std::size_t n = 0;
        for (bool first = true;; first = false) {
            // The farthest surface that is left, and all hits that belong to it.
            float farthest = -1e30f;
            for (const auto& direction : hits)
                for (const Found& f : direction)
                    if (f.found) farthest = std::max(farthest, f.coc_px);
            if (farthest < -1e29f) break;
            Met met;
            HiddenGuess next = surface(here, hits, farthest, met);
            const float inside = met.within / met.all;
            const float behind = all_behind + inside * (unhidden_behind - all_behind);
            next.seen.share = first ? 1 : sharpened(met.within / (met.within + behind + 1e-9f));
            all_behind += met.within, unhidden_behind += met.unhidden * inside;
            surfaces[n++] = next;
            if (n > kSurfaces) drop_least(surfaces), --n;
        }
        while (n > 0) hidden.push_back(surfaces[--n]);
    }

    // Removes the surface, of those ordered from the farthest to the nearest, that shows least of itself. The
    // farthest that stays fills the rest.
    static void drop_least(std::span<HiddenGuess> surfaces) {
        float open = 1, least = 2;
        std::size_t dropped = 0;
        for (std::size_t i = surfaces.size(); i-- > 0;) {
            const float shows = open * surfaces[i].seen.share;
            if (shows < least) least = shows, dropped = i;
            open *= 1 - surfaces[i].seen.share;
        }
        std::copy(surfaces.begin() + std::ptrdiff_t(dropped) + 1, surfaces.end(),
                  surfaces.begin() + std::ptrdiff_t(dropped));
        surfaces[0].seen.share = 1;
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
    HiddenGuess surface(const Here& here, Hits& hits, float coc_px, Met& met) const {
        Votes votes;
        HiddenTextures::Point hidden(textures_, here.x, here.y);
        const float nearest_px = nearest_of_surface(hits, coc_px);
        const auto take = [&](std::size_t k) -> const Found* {
            for (const Found& f : hits[k])
                if (f.found && f.coc_px >= nearest_px) return &f;
            return nullptr;
        };
        const auto passes = [&](const Found* f) {
            return f ? here.edges.passes({f->x, f->y}, f->coc_px) : 0;
        };
        const auto meet = [&](const Found& f) {
            const float share = 1 / f.distance_px;
            met.all += share;
            const HiddenOutlines::Open open = here.outlines.open({f.x, f.y}, f.coc_px);
            met.within += share * open.within, met.unhidden += share * open.unhidden;
        };
        float nearest = 1e9f;  // distance of the nearest hit, px
        for (std::size_t k = 0; k < kDirections; ++k)
            if (const Found* f = take(k)) nearest = std::min(nearest, f->distance_px);
        constexpr std::size_t kPairs = kDirections / 2;
        for (std::size_t k = 0; k < kPairs; ++k) {
            const Found *a = take(k), *b = take(k + kPairs);
            if (a) meet(*a);
            if (b) meet(*b);
            const float from_a = passes(a), from_b = passes(b), both = from_a * from_b;
            if (a && b) add_pair(hidden, *a, *b, k, both, votes);
            if (a && from_a > both) add_alone(here, hidden, *a, k, nearest, from_a - both, votes);
            if (b && from_b > both) add_alone(here, hidden, *b, k + kPairs, nearest, from_b - both, votes);
        }
        for (auto& direction : hits)
            for (Found& f : direction) f.found = f.found && f.coc_px < nearest_px;
        HiddenGuess guess = votes.mean();
        guess.smooth_px = completion_model.smooth_share * nearest;
        return guess;
    }
    // Adds the surfaces met in direction k and the opposite one.
    void add_pair(HiddenTextures::Point& hidden, const Found& a, const Found& b, std::size_t k, float weight,
                  Votes& votes) const {
        const float total = a.distance_px + b.distance_px;
        const float wa = b.distance_px / total, wb = a.distance_px / total;
        const float alike = likeness(a, search_.direction(k), b, search_.direction(k + kDirections / 2));
        const float closeness = 1 / a.distance_px + 1 / b.distance_px;
        const float vote = weight * (closeness * std::sqrt(closeness) * alike);
        votes.add(known_.colour(a.x, a.y), hidden.going_on(a.place()), wa * vote);
        votes.add(known_.colour(b.x, b.y), hidden.going_on(b.place()), wb * vote);
        votes.add(wa * a.coc_px + wb * b.coc_px, vote);
    }
    // Adds a surface met in direction k alone.
    void add_alone(const Here& here, HiddenTextures::Point& hidden, const Found& one, std::size_t k,
                   float nearest_px, float weight, Votes& votes) const {
        const float away = one.distance_px * one.distance_px;
        const Rgba colour = known_.going_on(one.place(), search_.direction(k), one.distance_px, here.edges);
        const float vote = weight * (completion_model.alone_weight * nearest_px / (away * one.distance_px));
        votes.add(colour, hidden.going_on(one.place()), vote);
        votes.add(one.coc_px, vote);
    }

    KnownSurfaces known_;
    HiddenOutlines outlines_;
    HiddenTextures textures_;
    View<const float> coc_;
    View<const unsigned char> connected_;
    const Mixtures& mixtures_;
    NearSilhouettes near_silhouettes_;
    SurfaceSearch search_;
    // Every how many directions are searched, and are searched first.
    std::size_t every_, every_first_;
};

constexpr int kLargestSquare = HiddenLayers::kBand;

// Hidden surfaces are seen through their own blur and, except their textures, as means (behind/smooth.h; not
// in previews), so pixels of one surface share the answer of the first pixel in a square. Returns the side of
// that square, pixels.
int shared_square(std::span<const HiddenGuess> hidden, const FillRule& rule) {
    float least_blur = 1e30f, least_mean_px = 1e30f;
    for (const HiddenGuess& g : hidden) {
        least_blur = std::min(least_blur, std::abs(g.seen.coc_px) / rule.shared_from_px);
        least_mean_px = std::min(least_mean_px, rule.smooths && g.plain == 1 ? g.smooth_px : 0);
    }
    if (least_blur >= 6) return kLargestSquare;
    if (least_blur >= 2 || least_mean_px >= 6) return 4;
    return least_blur >= 1 || least_mean_px >= 2 ? 2 : 1;
}

using Range = HiddenLayers::Range;

Range range(std::size_t begin, std::size_t end) {
    Range r{};
    r.begin = begin & ((1U << 30) - 1), r.count = (end - begin) & HiddenLayers::kMost;
    return r;
}

// The answers that were found so far in one square of kLargestSquare pixels.
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
    const FillRule& rule;
    Image<Range> ranges;  // of its pixels in `hidden`
    std::vector<HiddenGuess> hidden;
    Answers answers;

    void fill_square(const Rect& square) {
        answers.clear();
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0; x < square.x1; ++x) {
                const Mixture* m = mixtures.at(x, y);
                // (A silhouette's farther surface hides another one if it lies in front of focus itself.)
                if (m && m->shows_far && m->far_coc_px > -completion_model.apart_px()) continue;
                if ((m && !m->shows_far ? m->near_coc_px : coc(x, y)) > rule.hides_before_px) continue;
                const auto beside = m ? std::nullopt : filler.beside(x, y);
                if (!beside && (!m || m->shows_far) && !filler.may_hide(x, y)) continue;
                Range& own = ranges(x, y - rows.y0);
                const Range* const known = beside ? nullptr : answers.find(x, y, coc(x, y));
                if (known) {
                    own = *known;
                    continue;
                }
                const std::size_t begin = hidden.size();
                if (beside) hidden.push_back(*beside);
                filler.fill(x, y, hidden);
                hidden.resize(std::min(hidden.size(), begin + kSurfaces));
                own = range(begin, hidden.size());
                if (beside) continue;  // neighbours differ from this pixel
                // Nothing found here; neighbours closer to the silhouette may still find
                // something.
                if (own.count == 0) continue;
                answers.add(x, y, coc(x, y), shared_square(std::span(hidden).subspan(begin), rule), own);
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
    const Filler filler(picture, coc, connected, mixtures, nearest_coc_px, farthest_coc_px, rule, white,
                        workers);
    const int bands = (height + kLargestSquare - 1) / kLargestSquare;
    layers.bands.resize(std::size_t(bands));
    layers.ranges = {width, height};
    HiddenGuesses guesses(static_cast<std::size_t>(bands));
    parallel_for(bands, workers, [&](int i) {
        const Rect rows =
            Rect{0, i * kLargestSquare, width, (i + 1) * kLargestSquare}.intersected(coc.rect());
        Band band{filler, mixtures, coc, rows, rule, Image<Range>(width, rows.height()), {}, {}};
        for (int x = 0; x < width; x += kLargestSquare)
            band.fill_square(Rect{x, rows.y0, x + kLargestSquare, rows.y1}.intersected(rows));
        for (int y = rows.y0; y < rows.y1; ++y)
            layers.ranges.find_row(y, [&](const auto& emit) {
                for (int x = 0; x < width; ++x)
                    if (const Range r = band.ranges(x, y - rows.y0); r.count > 0) emit(x, r);
            });
        guesses[std::size_t(i)].assign(band.hidden.begin(), band.hidden.end());  // without spare capacity
    });
    if (std::all_of(guesses.begin(), guesses.end(), [](const auto& band) { return band.empty(); })) return {};
    if (rule.smooths) smooth(layers.ranges, guesses, filler.known(), workers);
    parallel_for(bands, workers, [&](int i) {
        std::vector<Hidden>& seen = layers.bands[std::size_t(i)];
        seen.reserve(guesses[std::size_t(i)].size());
        for (const HiddenGuess& g : guesses[std::size_t(i)])
            seen.push_back(
                {g.seen.share * (g.plain * g.seen.colour + g.texture), g.seen.coc_px, g.seen.share});
        guesses[std::size_t(i)] = {};
    });
    return layers;
}

}  // namespace petzval::engine
