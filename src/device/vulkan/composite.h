// A scatter plan drawn on the device: what device/cpu/composite.h does.
#pragma once

#include "device/vulkan/atlas.h"
#include "engine/scatter/plan.h"

#include <cstdint>

namespace petzval::device::vulkan {

// Work of one submission. The picture does not depend on it.
struct BatchRule {
    std::uint64_t most_multiply_adds = ~std::uint64_t(0);  // besides what a Pace allows
    std::size_t most_partial_bytes = std::size_t(64) << 20;
};

// Writes the pixels of the plan's rows. Throws Failed.
Work composite_tiles(Context& context, const engine::ScatterPlan& plan, const PackedAtlas& atlas, Target out,
                     const Control& control, const BatchRule& rule = {});

}  // namespace petzval::device::vulkan
