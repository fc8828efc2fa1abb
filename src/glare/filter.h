// Kernels that are so large that pictures are convolved with them by Fourier transforms.
#pragma once

#include "petzval/workers.h"

#include "glare/plan.h"
#include "kernel/model/lens_model.h"

namespace petzval::glare {

// Points a side of the transforms for a kernel that reaches so far, and pictures of this size.
int transform_size(int reach, int width, int height);

// Requires: kernel(-x) = kernel(x), odd sides around 0; 2 * reach < size.
Filter filter_of(const kernel::PointSpread& kernel, int size, Workers& workers);

}  // namespace petzval::glare
