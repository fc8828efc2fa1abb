// Lenses whose kernels take long to make, with those that were made last in memory. Places that mirror each
// other share one, where the lens is symmetric.
#pragma once

#include "kernel/keep/kernel_cache.h"
#include "kernel/model/lens_model.h"

#include <compare>
#include <cstddef>
#include <memory>

namespace petzval::kernel {

struct RememberedKernel {
    int lens = 0;  // a number that tells the lenses of one memory apart
    double coc_radius_px = 0, field_x = 0, field_y = 0;
    friend auto operator<=>(const RememberedKernel&,
                            const RememberedKernel&) = default;  // NOLINT(modernize-use-nullptr): not one
};

// One budget for all lenses that share it: the kernels not asked for longest go first.
using RememberedKernels = KernelCache<RememberedKernel>;

// The lens itself if it is quick. The bits of a kernel depend on its own ask, not on earlier ones. Requires:
// no other lens has this number in `kernels`.
std::unique_ptr<const LensModel> remembered(std::unique_ptr<const LensModel> lens,
                                            std::shared_ptr<RememberedKernels> kernels, int number);

}  // namespace petzval::kernel
