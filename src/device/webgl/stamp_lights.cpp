#include "device/webgl/stamp_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace petzval::device::webgl {

using engine::LightsPlan;
using engine::PlannedLight;

// Lights, coarsest level last: level, kernel, x, y (cells of the level), r, g, b, radius in cells, and the
// mask in two words, row by row from the lowest bit.
void hand_over_lights(const LightsPlan& plan, const PageAtlas& atlas) {
    const auto level_of = [&](std::uint32_t light) {
        return plan.kernels.asks[plan.lights[light].kernel].level;
    };
    std::vector<std::uint32_t> order(plan.lights.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return level_of(a) < level_of(b); });
    Words words;
    for (const std::uint32_t i : order) {
        const PlannedLight& light = plan.lights[i];
        const engine::Highlight& h = light.highlight;
        const std::uint64_t seen = plan.masks[light.viewpoint].seen;
        const int level = level_of(i);
        words.add_all(level, light.kernel, h.x, h.y, h.colour.r, h.colour.g, h.colour.b,
                      std::ldexp(h.coc_px, -level), std::uint32_t(seen), std::uint32_t(seen >> 32));
    }
    Words head;
    head.add_all(plan.picture.width(), plan.picture.height(), plan.stretch);
    head.hand_over("lights head");
    words.hand_over("lights list");
    atlas.hand_over("lights kernels", "lights weights");
}

}  // namespace petzval::device::webgl
