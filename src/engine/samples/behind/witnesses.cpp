#include "engine/samples/behind/witnesses.h"

#include "engine/samples/behind/likeness.h"
#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// A witness across its surface's structure loses so much weight that those along it decide. continues: the
// product of two answers of SurfaceStructure::continues(), of both ends of a pair or twice that of one end.
float weight_along(float continues) { return continues * continues * continues; }

}  // namespace

// Weighted votes on the colour of a hidden surface.
class Witnesses::Votes {
public:
    // A colour. A texture states a share of it.
    void add(Rgba colour, const HiddenTextures::Point::Told& told, float weight) {
        const float plain = weight * (1 - told.share);
        colour_ += plain * colour, plain_ += plain;
        texture_ += weight * told.colour;
        textured_ += weight * told.share;
    }
    void add(float coc_px, float weight) { coc_ += weight * coc_px, total_ += weight; }
    HiddenGuess mean() const {
        // (Exactly 1 without textures, for only then do pixels share a guess: rounding must not decide.)
        const float plain = std::max(0.0f, 1 - textured_ / total_);
        HiddenGuess guess{{{}, coc_ / total_, 1}, texture_ * (1 / total_), plain, 0};
        if (plain_ > 0) guess.seen.colour = colour_ * (1 / plain_);
        return guess;
    }

private:
    Rgba colour_, texture_;
    float plain_ = 0, textured_ = 0, coc_ = 0, total_ = 0;
};

HiddenGuess Witnesses::surface(const HiddenPixel& here, Hits& hits, Met& met) const {
    Votes votes;
    HiddenTextures::Point hidden(textures_, here.x, here.y);
    const auto take = [&](std::size_t k) -> const Found* {
        for (const Found& f : hits[k])
            if (f.on_surface) return &f;
        return nullptr;
    };
    const auto passes = [&](const Found* f) { return f ? here.edges.passes({f->x, f->y}, f->coc_px) : 0; };
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
        for (Found& f : direction) f.found = f.found && !f.on_surface;
    HiddenGuess guess = votes.mean();
    guess.smooth_px = completion_model.smooth_share * nearest;
    return guess;
}

// Adds the surfaces met in direction k and the opposite one.
void Witnesses::add_pair(HiddenTextures::Point& hidden, const Found& a, const Found& b, std::size_t k,
                         float weight, Votes& votes) const {
    const float total = a.distance_px + b.distance_px;
    const float wa = b.distance_px / total, wb = a.distance_px / total;
    const float alike = likeness(known_, a, search_.direction(k), b, search_.direction(k + kDirections / 2));
    const Direction doubled = SurfaceStructure::doubled(search_.direction(k));
    weight *=
        weight_along(structure_.continues(a.place(), doubled) * structure_.continues(b.place(), doubled));
    const float closeness = 1 / a.distance_px + 1 / b.distance_px;
    const float vote = weight * (closeness * std::sqrt(closeness) * alike);
    votes.add(known_.colour(a.x, a.y), hidden.going_on(a.place()), wa * vote);
    votes.add(known_.colour(b.x, b.y), hidden.going_on(b.place()), wb * vote);
    votes.add(wa * a.coc_px + wb * b.coc_px, vote);
}

// Adds a surface met in direction k alone.
void Witnesses::add_alone(const HiddenPixel& here, HiddenTextures::Point& hidden, const Found& one,
                          std::size_t k, float nearest_px, float weight, Votes& votes) const {
    const float continues =
        structure_.continues(one.place(), SurfaceStructure::doubled(search_.direction(k)));
    weight *= weight_along(continues * continues);
    const float away = one.distance_px * one.distance_px;
    const Rgba colour = known_.going_on(one.place(), search_.direction(k), one.distance_px, here.edges);
    const float vote = weight * (completion_model.alone_weight * nearest_px / (away * one.distance_px));
    votes.add(colour, hidden.going_on(one.place()), vote);
    votes.add(one.coc_px, vote);
}

}  // namespace petzval::engine
