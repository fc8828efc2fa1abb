#include "device/cpu/add_lights.h"

#include "base/parallel.h"
#include "device/cpu/pupil_shadow.h"
#include "engine/waist/holdout.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

namespace petzval::device {

using namespace engine;
using kernel::PointSpread;

namespace {

// A bright light finds every crack between the squares of a sloping surface.
constexpr float kOverlapPx = 0.02f;

// What stands in the way of lights.
class Shadows {
public:
    explicit Shadows(const LightsPlan& plan) : plan_(plan) {}

    // Null: nothing is in the way.
    std::unique_ptr<const PupilShadow> of(const Viewpoint& view) const {
        if (casters().nearest_coc_px() >= view.coc_px - view.own_surface_px) return nullptr;
        auto shadow = std::make_unique<PupilShadow>(view.coc_px, view.size % 2 == 0);
        if (!collect(view, *shadow)) return nullptr;
        shadow->finish();
        return shadow;
    }

private:
    const ShadowCasters& casters() const { return *plan_.casters; }
    bool collect(const Viewpoint& view, PupilShadow& shadow) const {
        constexpr int kBlock = ShadowCasters::kBlock;
        bool any = false;
        // Taps at the rim of the disc reach beyond it by half their width.
        const float pupil_end =
            plan_.stretch + (0.5f + 0.5f * float(view.size)) / std::max(0.5f, std::abs(view.coc_px));
        const auto reach_of = [&](float c) {
            return (view.coc_px - c) * plan_.stretch + 1 + float(view.size);
        };
        const int farthest = int(reach_of(casters().nearest_coc_px())) + kBlock;
        const Plane& blocks = casters().nearest_of_blocks();
        const int x = int(view.x), y = int(view.y);
        const Rect near = Rect{(x - farthest) / kBlock, (y - farthest) / kBlock, (x + farthest) / kBlock + 1,
                               (y + farthest) / kBlock + 1}
                              .intersected(blocks.rect());
        for (int by = near.y0; by < near.y1; ++by)
            for (int bx = near.x0; bx < near.x1; ++bx) {
                const float c = blocks(bx, by);
                if (c >= view.coc_px - view.own_surface_px) continue;
                const int dx = std::max({bx * kBlock - x, x - (bx + 1) * kBlock + 1, 0});
                const int dy = std::max({by * kBlock - y, y - (by + 1) * kBlock + 1, 0});
                if (float(dx * dx + dy * dy) > reach_of(c) * reach_of(c)) continue;
                any = cover_block(bx, by, view, pupil_end, shadow) || any;
            }
        return any;
    }

    bool cover_block(int bx, int by, const Viewpoint& view, float pupil_end, PupilShadow& shadow) const {
        bool any = false;
        float done = -1e30f;  // all that is nearer has been seen
        for (int coarse = ShadowCasters::kViews - 1; coarse >= 0; --coarse) {
            const float end =
                std::min(ShadowCasters::end_of_view(coarse, view.coc_px), view.coc_px - view.own_surface_px);
            if (end <= done) continue;
            for (const Caster& caster : casters().of_block(coarse, bx, by)) {  // nearest first
                if (caster.coc_px > end) break;
                if (caster.coc_px > done) any = cover(view, pupil_end, caster, shadow) || any;
            }
            done = end;
        }
        return any;
    }

    static bool cover(const Viewpoint& view, float pupil_end, const Caster& caster, PupilShadow& shadow) {
        const float apart = view.coc_px - caster.coc_px;
        if (caster.size > 1 && apart < ShadowCasters::kSameRadiusPx) return false;
        const float per_px = 1 / apart;
        const float u = (caster.x - view.x) * per_px, v = (caster.y - view.y) * per_px;
        // A tap sees each pixel of the highlight through another place of the caster's plane, wider apart the
        // further that plane is from focus.
        const float blur =
            float(view.size - 1) * std::abs(caster.coc_px) / std::max(1.0f, std::abs(view.coc_px));
        const float side = caster.size + kOverlapPx;
        if (std::max(std::abs(u), std::abs(v)) - 0.5f * (side + blur) * per_px >= pupil_end) return false;
        shadow.cover(u, v, side * per_px, blur * per_px, caster.coverage);
        return true;
    }

    const LightsPlan& plan_;
};

// A light with what its place in the plan stands for.
struct Sent {
    const Highlight& light;
    const PointSpread& kernel;
    const PupilShadow* shadow;
    int first_tap;
    Rect extent() const {
        const Rect& e = kernel.extent;
        return {light.x + e.x0, light.y + e.y0, light.x + e.x1, light.y + e.y1};
    }
};

// Only pixels of `rows` are written.
void add(const Sent& sent, const LightsPlan& plan, const Rect& rows, View<Rgba> out) {
    const Highlight& h = sent.light;
    const Rect e = sent.kernel.extent, place = sent.extent().intersected(rows);
    if (place.empty()) return;
    const Rgba light = h.colour * float(h.size * h.size);
    std::vector<float> shares(std::size_t(place.width()), 1.0f);
    for (int y = place.y0; y < place.y1; ++y) {
        if (sent.shadow)
            sent.shadow->visible(place.x0 - h.x - sent.first_tap, y - h.y - sent.first_tap, shares);
        if (!plan.holdout.empty())
            for (int x = place.x0; x < place.x1; ++x)
                shares[std::size_t(x - place.x0)] = (sent.shadow ? shares[std::size_t(x - place.x0)] : 1) *
                                                    let_through(plan.holdout, x, y, h.coc_px);
        const Rgba* const weights = sent.kernel.weights.row(y - h.y - e.y0) + (place.x0 - h.x - e.x0);
        add_shares({weights, shares.size()}, light, shares, out.row(plan.first_row + y) + place.x0);
    }
}

}  // namespace

// Shadows are found in parallel, and light is added in the order of the plan: the same bits for any threads.
Work add_planned_lights(const LightsPlan& plan, const SpreadAtlas& atlas, View<Rgba> out,
                        const Control& control) {
    std::vector<std::unique_ptr<const PupilShadow>> shadows(plan.viewpoints.size());
    parallel_for(int(shadows.size()), control.workers, [&](int i) {
        if (!control.progress.cancelled())
            shadows[std::size_t(i)] = Shadows(plan).of(plan.viewpoints[std::size_t(i)]);
    });
    if (control.progress.cancelled()) return {};
    const auto sent = [&](const PlannedLight& l) {
        return Sent{l.highlight, atlas[l.kernel], shadows[l.viewpoint].get(),
                    plan.viewpoints[l.viewpoint].first_tap()};
    };
    constexpr int kBand = 32;
    parallel_for((plan.rows.height() + kBand - 1) / kBand, control.workers, [&](int band) {
        const int y = plan.rows.y0 + band * kBand;
        const Rect here = Rect{plan.rows.x0, y, plan.rows.x1, y + kBand}.intersected(plan.rows);
        for (const PlannedLight& light : plan.lights) add(sent(light), plan, here, out);
    });
    std::size_t taps = 0;
    for (const PlannedLight& light : plan.lights) {
        const Rect drawn = sent(light).extent().intersected(plan.rows);
        if (!drawn.empty()) taps += std::size_t(drawn.width()) * std::size_t(drawn.height());
    }
    return Work::of_taps(taps);
}

}  // namespace petzval::device
