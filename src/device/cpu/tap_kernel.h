// A kernel as the loop of gathering wants it (device/cpu/gather_taps.h).
#pragma once

#include "petzval/image.h"

#include "device/kernels.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace petzval::device {

// Cells that it reads for a few rows of output at once, with their weights.
struct TapKernel {
    struct Step {
        int dx, dy;  // from the first of the rows to what is read, cells
    };
    std::vector<Step> steps;
    std::vector<float> weights;
    bool neutral = true;  // one weight per row for all channels, else r, g, b and a for coverage
    Rect extent;          // of where light lands, from its source
    std::size_t bytes = 0;

    static std::shared_ptr<const TapKernel> laid_out(const KernelSource::Made& spreads);
};

}  // namespace petzval::device
