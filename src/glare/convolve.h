// A picture convolved with a large kernel, by fast Fourier transforms of overlapping tiles (T. G. Stockham,
// High-speed convolution and correlation, 1966: overlap-add). Memory depends on the kernel's size alone.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "kernel/model/lens_model.h"

namespace petzval::glare {

// out += amount * (light convolved with kernel), r, g, b only. Tiles without light cost nothing; what falls
// outside the picture is dropped. Requires: both of one size; kernel(-x) = kernel(x), odd sides around 0.
void add_convolved(View<Rgba> out, View<const Rgba> light, const kernel::PointSpread& kernel, float amount,
                   Workers& workers);

}  // namespace petzval::glare
