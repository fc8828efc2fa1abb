// The quick star of a picture, by its plan.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "glare/plan.h"

#include <span>

namespace petzval::device {

// out += amount * streaks of `light`. r, g, b each keep their sum inside the frame.
void add_streaks(View<Rgba> out, View<const Rgba> light, std::span<const glare::Streak> streaks, float amount,
                 Workers& workers);

}  // namespace petzval::device
