// Glare laid over a picture, by its plan.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "device/device.h"
#include "glare/plan.h"

namespace petzval::device {

// The part of a picture's light that stands above a threshold.
Picture highlights(View<const Rgba> picture, float threshold, Workers& workers);

// In place: what each part takes is subtracted where it was, what each throws is added.
void add_planned_glare(const glare::GlarePlan& plan, View<Rgba> picture, Workers& workers,
                       const Passed& passed);

}  // namespace petzval::device
