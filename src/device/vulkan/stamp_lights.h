// Lights with masks drawn on the device: what device/cpu/lights/stamp_lights.h does.
#pragma once

#include "device/vulkan/atlas.h"
#include "engine/lights/plan.h"

#include <cstddef>
#include <cstdint>

namespace petzval::device::vulkan {

// Work of one submission. The picture does not depend on it, except for the order of sums where the lights of
// one tile are cut.
struct StampRule {
    std::size_t most_tiles = 16;
    std::size_t most_lights = std::size_t(1) << 18;  // in tiles: one that touches two counts twice
    std::size_t most_weight_bytes = std::size_t(64) << 20;
    std::uint64_t most_multiply_adds = std::uint64_t(1) << 30;
};

// Adds to the plan's pixels of `out`. Throws Failed, and has added whole batches of lights then.
Work stamp_planned_lights(Context& context, const engine::LightsPlan& plan, const PackedAtlas& atlas,
                          Target out, const Control& control, const StampRule& rule = {});

}  // namespace petzval::device::vulkan
