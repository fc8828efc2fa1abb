#include "device/cpu/lights/add_lights.h"

#include "base/parallel.h"
#include "device/cpu/lights/pupil_shadow.h"
#include "engine/lights/shadow_plan.h"
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

// Null: no occluder.
std::unique_ptr<const PupilShadow> shadow_of(const LightsPlan& plan, const Viewpoint& view) {
    const std::vector<SeenCaster> casters = seen_casters(plan, view);
    if (casters.empty()) return nullptr;
    auto shadow = std::make_unique<PupilShadow>(ShadowGrid(view));
    shadow->cover(casters);
    shadow->finish();
    return shadow;
}

// A light with the data its plan entry refers to.
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
            shadows[std::size_t(i)] = shadow_of(plan, plan.viewpoints[std::size_t(i)]);
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
