// Bloom of a picture, by its plan.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "glare/plan.h"

namespace petzval::device {

// The layers of `light` (alpha ignored) together, each with its share. Requires: a picture that is not empty.
Picture bloom(const Picture& light, const glare::BloomPlan& plan, Workers& workers);

}  // namespace petzval::device
