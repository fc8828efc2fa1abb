// A lens whose kernels take long to make, with those that were made last in memory. Places that mirror each
// other share one, where the lens is symmetric.
#pragma once

#include "kernel/model/lens_model.h"

#include <cstddef>
#include <memory>

namespace petzval::kernel {

// The lens itself if it is quick. Bits depend on what is asked, not on what was asked before.
std::unique_ptr<const LensModel> remembered(std::unique_ptr<const LensModel> lens, std::size_t max_bytes);

}  // namespace petzval::kernel
