// A draft's plan drawn on the device: what device/cpu/mix.h does.
#pragma once

#include "device/device.h"
#include "device/vulkan/driver/recording.h"
#include "engine/gaussian/plan.h"

#include <cstddef>

namespace petzval::device::vulkan {

// Writes all of `out`, by bands of rows that take no more memory than this, or hold as many rows as surround
// them. What is drawn does not depend on it. Throws Failed.
void mix_blurs(Context& context, const engine::GaussianPlan& plan, Target out, const Control& control,
               std::size_t most_bytes = std::size_t(64) << 20);

}  // namespace petzval::device::vulkan
