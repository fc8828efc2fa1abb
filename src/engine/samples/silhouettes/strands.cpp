#include "engine/samples/silhouettes/strands.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/silhouettes/two_surfaces.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace petzval::engine {
namespace {

constexpr int kBlock = SparseRows<Mixture>::kBand;  // side of a block in pixels

// The colour of one strand by its pixels in a block: the least squares of share * colour = light.
struct Statement {
    float coc_px = 0, share2 = 0;  // share2: sum of squared shares
    float x = 0, y = 0;            // of the pixels, weighted by them
    Rgba light;                    // sum of share * light
};

class Strands {
public:
    Strands(const Mixtures& mixtures, const LitPicture& picture, View<const float> coc, int reach_px,
            Workers& workers)
        : mixtures_(mixtures),
          picture_(picture),
          coc_(coc),
          reach_px_(std::min(reach_px, kMostReachPx)),
          width_((coc.width() + kBlock - 1) / kBlock),
          height_((coc.height() + kBlock - 1) / kBlock),
          blocks_(std::size_t(width_) * std::size_t(height_)) {
        parallel_for(height_, workers, [&](int by) {
            for (int y = by * kBlock; y < std::min((by + 1) * kBlock, coc.height()); ++y)
                mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
                    if (m.thin && coc(x, y) <= threshold(m)) state(x, y, m);
                });
        });
    }

    // Writes what the pixel shows of the strand and of the surface behind.
    void separate(int x, int y, Mixture& m) const {
        const Guess near{colour(x, y, m), m.near_variance}, far = behind(x, y, m, near.colour);
        const Rgba c = picture_.dim(x, y);
        const Explained e = expected(comparable(c), near, far, m.share_by_shape, m.errors());
        m.near_clean = near.colour;
        m.shows_far = m.shows_far || e.near_share < completion_model.covers;
        m.far_colour = far.colour;
        if (m.shows_far) m.take_apart(c, e.near_share, e.far_colour);
    }

private:
    static float threshold(const Mixture& m) { return 0.5f * (m.near_coc_px + m.far_coc_px); }
    static float share_at(const Mixture* m) { return m ? m->share_by_shape : 0; }

    // Adds what a pixel that shows the strand states of its colour. The background, told by the pixels
    // beside it, holds a part of the strand itself.
    void state(int x, int y, const Mixture& m) {
        constexpr int kBeside = 2;
        Rgba far;
        float far_holds = 0, total = 0;
        const Rect window =
            Rect{x - kBeside, y - kBeside, x + kBeside + 1, y + kBeside + 1}.intersected(coc_.rect());
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                if (coc_(u, v) <= threshold(m)) continue;
                const float d2 = float((u - x) * (u - x) + (v - y) * (v - y)), weight = 1 / (1 + d2 * d2);
                far += weight * comparable(picture_.dim(u, v));
                far_holds += weight * share_at(mixtures_.at(u, v));
                total += weight;
            }
        far_holds /= total;
        const float share = (m.share_by_shape - far_holds) / (1 - far_holds);
        constexpr float kLeast = 0.05f;  // a pixel that holds hardly more than those beside it states nothing
        if (!(share > kLeast)) return;
        const Rgba light = comparable(picture_.dim(x, y)) - ((1 - share) / total) * far;
        const float share2 = share * share;
        Statement& s = statement(x / kBlock, y / kBlock, m.near_coc_px);
        s.share2 += share2;
        s.x += share2 * float(x), s.y += share2 * float(y);
        s.light += share * light;
    }
    Statement& statement(int bx, int by, float coc_px) {
        auto& block = blocks_[std::size_t(by) * std::size_t(width_) + std::size_t(bx)];
        for (Statement& s : block)
            if (one_surface(s.coc_px, coc_px)) return s;
        block.emplace_back().coc_px = coc_px;
        return block.back();
    }

    // The strand's colour, from the statements around the pixel; where there are none, that of its pixels
    // least like the far side.
    Rgba colour(int x, int y, const Mixture& m) const {
        float share2 = 0;
        Rgba light;
        const int bx = x / kBlock, by = y / kBlock;
        for (int v = std::max(0, by - 1); v <= std::min(height_ - 1, by + 1); ++v)
            for (int u = std::max(0, bx - 1); u <= std::min(width_ - 1, bx + 1); ++u)
                for (const Statement& s : blocks_[std::size_t(v) * std::size_t(width_) + std::size_t(u)]) {
                    if (!one_surface(s.coc_px, m.near_coc_px)) continue;
                    const float dx = s.x / s.share2 - float(x), dy = s.y / s.share2 - float(y);
                    const float weight = 1 / (1 + (dx * dx + dy * dy) / float(kBlock * kBlock));
                    share2 += weight * s.share2;
                    light += weight * s.light;
                }
        return share2 > 0 ? light_only((1 / share2) * light) : m.near_clean;
    }

    // A pixel that shows the surface behind. weight: near_by, and less for bright pixels.
    struct Shown {
        Rgba colour;
        const Mixture* at;  // the strand mixes into the pixel; null: the pixel is clean
        float near_by, weight;
    };
    static constexpr int kMostReachPx = 5;  // of UnmixRule::clean_within_px
    static constexpr std::size_t kWindowPx = 2 * kMostReachPx + 1, kMostShown = kWindowPx * kWindowPx;

    // The surface behind, from all pixels around that show it. Those that the strand mixes into count after
    // its part was taken out, and less if the error of that part exceeds the surface's own variance.
    Guess behind(int x, int y, const Mixture& m, Rgba near) const {
        constexpr float kDark = 1e-3f;  // keeps reciprocals finite
        const float own_light = std::max(0.0f, luminance(picture_.dim(x, y))) + kDark;
        const float third = third_surface_px(coc_(x, y), threshold(m));
        const Rect window =
            Rect{x - reach_px_, y - reach_px_, x + reach_px_ + 1, y + reach_px_ + 1}.intersected(coc_.rect());
        const auto dimmer = [&](Rgba c) { return 1 / (own_light + std::max(0.0f, luminance(c))); };
        Pool clean, mixed, all;
        std::array<Shown, kMostShown> shown;
        std::size_t count = 0;
        for (int v = window.y0; v < window.y1; ++v)
            for (int u = window.x0; u < window.x1; ++u) {
                if (coc_(u, v) > third || coc_(u, v) <= threshold(m)) continue;
                const float d2 = float((u - x) * (u - x) + (v - y) * (v - y)), near_by = 1 / (1 + d2 * d2);
                const Rgba c = picture_.dim(u, v);
                const Mixture* const at = mixtures_.at(u, v);
                const float weight = near_by * dimmer(c);
                (at ? mixed : clean).add(c, weight);
                shown[count++] = {c, at, near_by, weight};
            }
        const Guess first = (clean.empty() ? mixed : clean).guess();
        const float own = first.variance + least_variance(first.colour, m.errors());
        const float off = m.errors() * completion_model.shape_error;
        const float error = off * off * distance2(near, first.colour) / 3;
        for (const Shown& s : std::span(shown).first(count)) {
            if (!s.at) {
                all.add(s.colour, s.weight);
                continue;
            }
            if (s.at->lit) continue;
            const float rest = std::max(0.05f, 1 - s.at->share_by_shape);
            Rgba cleared = light_only((1 / rest) * (comparable(s.colour) - (1 - rest) * near));
            cleared.a = s.colour.a;
            all.add(cleared, s.near_by * dimmer(cleared) * rest * rest * own / (own + error));
        }
        return all.empty() ? first : all.guess();
    }

    const Mixtures& mixtures_;
    const LitPicture& picture_;
    View<const float> coc_;
    int reach_px_, width_, height_;
    std::vector<std::vector<Statement>> blocks_;
};

}  // namespace

void unmix_strands(Mixtures& mixtures, const LitPicture& picture, View<const float> coc, Workers& workers,
                   const UnmixRule& rule) {
    const Strands strands(mixtures, picture, coc, rule.clean_within_px, workers);
    parallel_for(coc.height(), workers, [&](int y) {
        mixtures.for_each_in_row(y, [&](int x, Mixture& m) {
            if (m.thin) strands.separate(x, y, m);
        });
    });
}

}  // namespace petzval::engine
