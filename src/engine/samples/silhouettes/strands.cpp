#include "engine/samples/silhouettes/strands.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/silhouettes/strand_colours.h"
#include "engine/samples/silhouettes/two_surfaces.h"

#include <algorithm>
#include <array>
#include <span>

namespace petzval::engine {
namespace {

class Strands {
public:
    Strands(const Mixtures& mixtures, const LitPicture& picture, View<const float> coc, int reach_px,
            Workers& workers)
        : colours_(mixtures, picture, coc, workers),
          mixtures_(mixtures),
          picture_(picture),
          coc_(coc),
          reach_px_(std::min(reach_px, kMostReachPx)) {}

    // Writes what the pixel shows of the strand and of the surface behind.
    void separate(int x, int y, Mixture& m) const {
        const Guess near{m.enclosed ? m.near_clean : colours_.at(x, y, m), m.near_variance};
        const Guess far = behind(x, y, m, near.colour);
        const Rgba c = picture_.dim(x, y);
        const Explained e = expected(comparable(c), near, far, m.share_by_shape, m.errors(picture_));
        m.near_clean = near.colour;
        m.shows_far = m.shows_far || e.near_share < completion_model.covers;
        m.far_colour = far.colour;
        if (m.shows_far) m.take_apart(c, e.near_share, e.far_colour);
    }

private:
    // A pixel that shows the surface behind. weight: near_by, and less for bright pixels.
    struct Shown {
        Rgba colour;
        const Mixture* at;  // the strand mixes into the pixel; null: the pixel is clean
        float near_by, weight;
        bool is_gap;
    };
    // near_by of a pixel beside. The pixel itself counts no more: light of the strand that neither its colour
    // nor the background explains, such as that of a lit side, would be its own witness.
    static constexpr float kBeside = 0.5f;
    static constexpr int kMostReachPx = 5;  // of UnmixRule::clean_within_px
    static constexpr int kWiderPx = 4;      // where no clean pixel of the surface behind is within reach
    static constexpr std::size_t kWindowPx = 2 * kMostReachPx + 1, kMostShown = kWindowPx * kWindowPx;

    // visit(u, v, near_by) for the pixels around that show the surface behind a strand at (x, y).
    template <typename Visit>
    void for_each_behind(int x, int y, int reach_px, float threshold_px, const Visit& visit) const {
        const FarSide side = far_side(coc_(x, y), threshold_px);
        const Rect window =
            Rect{x - reach_px, y - reach_px, x + reach_px + 1, y + reach_px + 1}.intersected(coc_.rect());
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                if (!side.shows(coc_(u, v))) continue;
                const float d2 = float((u - x) * (u - x) + (v - y) * (v - y));
                visit(u, v, 1 / (1 + d2 * d2));
            }
    }
    // The pixel's mixture, if something before the threshold mixes into it; null: nothing does.
    const Mixture* mixture_before(int x, int y, float threshold_px) const {
        const Mixture* const m = mixtures_.at(x, y);
        return m && m->near_coc_px <= threshold_px ? m : nullptr;
    }
    // True if something before the threshold shows 2 x 3 pixels of itself within 2 px. The depth then shows
    // all of its pixels.
    bool is_wide(int x, int y, float threshold_px) const {
        constexpr int kWithinPx = 2;
        const auto shows = [&](int left, int top, int width, int height) {
            for (int v = top; v < top + height; ++v)
                for (int u = left; u < left + width; ++u)
                    if (!coc_.rect().contains(u, v) || coc_(u, v) > threshold_px) return false;
            return true;
        };
        for (int dy = -kWithinPx; dy < kWithinPx; ++dy)
            for (int dx = -kWithinPx; dx < kWithinPx; ++dx)
                if ((dx + 1 < kWithinPx && shows(x + dx, y + dy, 3, 2)) ||
                    (dy + 1 < kWithinPx && shows(x + dx, y + dy, 2, 3)))
                    return true;
        return false;
    }
    // True if the pixel lies between two pixels that show strands. The shape of one silhouette says little
    // about the share of both strands in it.
    bool is_gap(int x, int y, float threshold_px) const {
        const auto near = [&](int u, int v) {
            return coc_.rect().contains(u, v) && coc_(u, v) <= threshold_px;
        };
        return (near(x - 1, y) && near(x + 1, y)) || (near(x, y - 1) && near(x, y + 1));
    }
    // The surface behind, from all pixels around that show it. Those that the strand mixes into count after
    // its part was taken out, and less if the error of that part exceeds the surface's own variance. The part
    // is a mean of two, one by the silhouette's shape and one by the pixel's colour, weighted by their
    // errors: before a plain wall, the colour decides. Gaps count where no other pixel shows the surface.
    Guess behind(int x, int y, const Mixture& m, Rgba near) const {
        const float own_light = std::max(0.0f, luminance(picture_.dim(x, y))) + picture_.black();
        const float threshold = strand_threshold_px(m);
        const auto dimmer = [&](Rgba c) { return 1 / (own_light + std::max(0.0f, luminance(c))); };
        Pool clean, evenly, mixed, all, gaps;  // evenly: the clean pixels, near and far ones alike
        const auto add_clean = [&](Rgba c, float near_by) {
            clean.add(c, near_by * dimmer(c)), evenly.add(c, dimmer(c));
        };
        std::array<Shown, kMostShown> shown;
        std::size_t count = 0;
        for_each_behind(x, y, reach_px_, threshold, [&](int u, int v, float near_by) {
            const Rgba c = picture_.dim(u, v);
            const Mixture* const at = mixture_before(u, v, threshold);
            if (at) mixed.add(c, near_by * dimmer(c));
            if (!at) add_clean(c, near_by);
            if (at) near_by = std::min(near_by, kBeside);
            shown[count++] = {c, at, near_by, near_by * dimmer(c), at && is_gap(u, v, threshold)};
        });
        if (clean.empty())
            for_each_behind(x, y, reach_px_ + kWiderPx, threshold, [&](int u, int v, float near_by) {
                if (!mixture_before(u, v, threshold)) add_clean(picture_.dim(u, v), near_by);
            });
        const Guess first = (clean.empty() ? mixed : clean).guess();
        const float own = first.variance + least_variance(first.colour, m.errors(picture_));
        const Rgba across = near - first.colour;
        const float apart2 = std::max(1e-16f, dot(across, across)) / 3;  // mean of the channels, as variances
        const float off = m.errors(picture_).times * completion_model.shape_error, shape_error2 = off * off;
        const float colour_error2 = clean.empty() ? 1e9f : (own + evenly.guess().variance) / apart2;
        const float by_shape =
            !m.enclosed && is_wide(x, y, threshold) ? 1 : colour_error2 / (colour_error2 + shape_error2);
        const float error = by_shape * shape_error2 * apart2;
        for (const Shown& s : std::span(shown).first(count)) {
            if (!s.at) {
                all.add(s.colour, s.weight);
                continue;
            }
            if (s.at->lit) continue;
            const float by_colour =
                std::clamp(dot(comparable(s.colour) - first.colour, across) / (3 * apart2), 0.0f, 1.0f);
            const float part = by_colour + by_shape * (s.at->share_by_shape - by_colour);
            const float rest = std::max(0.05f, 1 - part);
            Rgba cleared = light_only((1 / rest) * (comparable(s.colour) - (1 - rest) * near));
            cleared.a = s.colour.a;
            (s.is_gap ? gaps : all)
                .add(cleared, s.near_by * dimmer(cleared) * rest * rest * own / (own + error));
        }
        const Pool& told = all.empty() ? gaps : all;
        return told.empty() ? first : told.guess();
    }

    StrandColours colours_;
    const Mixtures& mixtures_;
    const LitPicture& picture_;
    View<const float> coc_;
    int reach_px_;
};

}  // namespace

void unmix_strands(Mixtures& mixtures, const LitPicture& picture, View<const float> coc, Workers& workers,
                   const UnmixRule& rule) {
    const Strands strands(mixtures, picture, coc, rule.clean_within_px, workers);
    parallel_for(coc.height(), workers, [&](int y) {
        mixtures.for_each_in_row(y, [&](int x, Mixture& m) {
            if (m.thin || m.enclosed) strands.separate(x, y, m);
        });
    });
}

}  // namespace petzval::engine
