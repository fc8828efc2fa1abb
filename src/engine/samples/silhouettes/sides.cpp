#include "engine/samples/silhouettes/sides.h"

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/outlines/outline.h"
#include "engine/samples/silhouettes/touching.h"

#include <algorithm>

namespace petzval::engine {

Sides look_around(const LitPicture& picture, View<const float> coc, View<const float> stated,
                  View<const unsigned char> touching, int x, int y, float threshold, const UnmixRule& rule) {
    Sides s;
    const int reach = rule.clean_within_px;
    const Rect window = Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(coc.rect());
    const float own_light = std::max(0.0f, luminance(picture.dim(x, y))) + picture.black();
    const FarSide side = far_side(coc(x, y), threshold);
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            const bool near = coc(u, v) <= threshold;
            if (!near && !side.shows(coc(u, v))) continue;
            const float d2 = float((u - x) * (u - x) + (v - y) * (v - y));
            const Rgba colour = picture.dim(u, v);
            // Far pixels count little, and pixels much brighter than this one too: a lamp nearby is not this
            // surface.
            const float weight = 1 / ((1 + d2 * d2) * (own_light + std::max(0.0f, luminance(colour))));
            if (near) {
                s.near_brightest = std::max(s.near_brightest, luminance(comparable(picture.colour(u, v))));
                if (!touching(u, v)) s.near_clean.add(colour, weight);
                if (d2 < s.near_closest) s.near_closest = d2, s.near_coc = coc(u, v);
            } else {
                (touching(u, v) ? s.far_mixed : s.far_clean).add(colour, weight);
                s.far_most = {std::max(s.far_most.r, colour.r), std::max(s.far_most.g, colour.g),
                              std::max(s.far_most.b, colour.b), 1};
                if (d2 < s.far_closest) s.far_closest = d2, s.far_coc = coc(u, v);
            }
        }
    s.near_share_by_shape = Outline(stated, x, y, threshold).near_share(rule.along_outline);
    return s;
}

Guess least_like(Rgba far_colour, const LitPicture& picture, View<const float> coc,
                 View<const unsigned char> touching, int x, int y, float threshold) {
    const int reach = int(completion_model.thin_within_px);
    Pool unlit, lit;
    for (int v = std::max(0, y - reach); v <= std::min(coc.height() - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(coc.width() - 1, x + reach); ++u) {
            if (coc(u, v) > threshold) continue;
            const Rgba colour = picture.dim(u, v);
            ((touching(u, v) & kLit) != 0 ? lit : unlit)
                .add(colour, distance2(comparable(colour), far_colour) + 1e-16f);
        }
    return (unlit.empty() ? lit : unlit).guess();
}

}  // namespace petzval::engine
