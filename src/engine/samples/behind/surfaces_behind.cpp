#include "engine/samples/behind/surfaces_behind.h"

#include "engine/samples/behind/one_surface.h"
#include "engine/samples/completion_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace petzval::engine {
namespace {

// All directions are searched so close to a hidden outline: the share of its surface depends on them.
constexpr float kCloseToOutlinePx = 4;
constexpr std::size_t kSurfaces = HiddenLayers::kMost;

// Rounds a share: a surface with most of the surroundings gets nearly all, one with little nearly nothing.
// (Smoothstep, twice.) One that would show less than kLeast covers nothing: every light would search it for
// its shadow.
float sharpened(float share) {
    constexpr float kLeast = 0.002f;
    const float once = share * share * (3 - 2 * share), twice = once * once * (3 - 2 * once);
    if (twice > 1 - kLeast) return 1;
    return twice < kLeast ? 0 : twice;
}

// Removes the surface, of those ordered from the farthest to the nearest, that shows least of itself. The
// farthest that stays fills the rest.
void drop_least(std::span<HiddenGuess> surfaces) {
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

}  // namespace

SurfacesBehind::SurfacesBehind(const LitPicture& picture, View<const float> coc_px,
                               View<const unsigned char> connected, const Mixtures& mixtures,
                               float nearest_px, float farthest_px, const FillRule& rule, float white,
                               Workers& workers)
    : known_(picture, coc_px, mixtures, white, workers, rule.edges_to_px),
      structure_(known_, mixtures, workers),
      outlines_(coc_px, workers),
      textures_(known_, mixtures, rule.textures ? std::max(-nearest_px, farthest_px) : 0, workers),
      coc_(coc_px),
      connected_(connected),
      mixtures_(mixtures),
      near_silhouettes_(coc_px, mixtures, workers),
      search_(known_, coc_px, connected, mixtures, nearest_px, farthest_px, workers),
      witnesses_(known_, structure_, textures_, search_),
      every_(std::size_t(kDirections / rule.directions)),
      every_first_(std::size_t(kDirections / rule.first_directions)) {}

float SurfacesBehind::fill(int x, int y, std::vector<HiddenGuess>& hidden) const {
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
    return outline_px;
}

// Appends the surfaces that were met, nearest first. The farthest surface fills the rest. A nearer surface
// gets the share that it has of the surroundings, so a wire behind a leaf continues as a wire. Beside its own
// hidden outline, it gets everything on its side.
void SurfacesBehind::stack(const HiddenPixel& here, Hits& hits, std::vector<HiddenGuess>& hidden) const {
    float all_behind = 0, unhidden_behind = 0;
    std::array<HiddenGuess, kSurfaces + 1> surfaces;
    std::size_t n = 0;
    for (bool first = true; mark_farthest_surface(hits); first = false) {
        Met met;
        HiddenGuess next = witnesses_.surface(here, hits, met);
        const float inside = met.within / met.all;
        const float behind = all_behind + inside * (unhidden_behind - all_behind);
        next.seen.share = first ? 1 : sharpened(met.within / (met.within + behind + 1e-9f));
        all_behind += met.within, unhidden_behind += met.unhidden * inside;
        surfaces[n++] = next;
        if (n > kSurfaces) drop_least(surfaces), --n;
    }
    while (n > 0) hidden.push_back(surfaces[--n]);
}

}  // namespace petzval::engine
