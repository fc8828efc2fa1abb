// A picture convolved with a large kernel, by fast Fourier transforms of overlapping tiles (T. G. Stockham,
// High-speed convolution and correlation, 1966: overlap-add). Memory depends on the kernel's size alone.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "glare/plan.h"

namespace petzval::device {

// out += amount * (light convolved with the kernel), r, g, b only. Tiles without light cost nothing; what
// falls outside the picture is dropped. Requires: both of one size.
void add_convolved(View<Rgba> out, View<const Rgba> light, const glare::Filter& filter, float amount,
                   Workers& workers);

}  // namespace petzval::device
