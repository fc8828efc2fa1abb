// Drafts: the sharp picture mixed with its planned blurs.
#pragma once

#include "device/device.h"
#include "engine/gaussian/plan.h"

namespace petzval::device {

// Writes all of `out`.
void mix_blurs(const engine::GaussianPlan& plan, View<Rgba> out, const Control& control);

}  // namespace petzval::device
