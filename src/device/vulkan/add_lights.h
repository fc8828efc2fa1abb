// Lights with viewpoints drawn on the device: what device/cpu/lights/add_lights.h does.
#pragma once

#include "device/vulkan/atlas.h"
#include "device/vulkan/pupil_shadows.h"
#include "engine/lights/plan.h"

namespace petzval::device::vulkan {

// Work of one submission if memory allows it. Sums are the same up to rounding.
struct LightsRule {
    std::size_t most_cells = std::size_t(8) << 20;  // of pupils that are covered
    std::size_t most_views = 1024;
    ShadowsRule shadows;
    std::size_t most_tiles = 1024;
    std::uint64_t most_multiply_adds = std::uint64_t(1) << 30;
};

// Adds to the plan's rows of `out`. Throws Failed, and has added whole batches of lights then.
Work add_planned_lights(Context& context, const engine::LightsPlan& plan, const PackedAtlas& atlas,
                        Target out, const Control& control, const LightsRule& rule = {});

// Push constants of shaders/add_lights.comp, documented there.
struct LightsPush {
    std::uint32_t tiles = 0, order = 0, lights = 0, views = 0, records = 0;
    std::uint32_t held_row = 0, held_width = 0, held_samples = 0;
    float stretch = 1;
};
static_assert(sizeof(LightsPush) == 36);

}  // namespace petzval::device::vulkan
