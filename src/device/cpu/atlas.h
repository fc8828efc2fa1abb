// Kernels laid out for the loops of this machine.
#pragma once

#include "device/cpu/stamp.h"
#include "device/cpu/tap_kernel.h"
#include "device/laid_out.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace petzval::device {

// The kernels of one ask: one, or one for each sector of the pupil.
struct StampSet {
    std::vector<engine::StampKernel> kernels;
    std::size_t taps = 0, bytes = 0;  // of all of them; taps count the padding

    static std::shared_ptr<const StampSet> laid_out(const KernelSource::Made& spreads);
};

template <typename Kernel>
class LaidOutAtlas final : public Atlas {
public:
    explicit LaidOutAtlas(std::vector<std::shared_ptr<const Kernel>> kernels)
        : kernels_(std::move(kernels)) {}
    const Kernel& operator[](std::uint32_t kernel) const { return *kernels_[kernel]; }

private:
    std::vector<std::shared_ptr<const Kernel>> kernels_;  // in the order of the set
};
using StampAtlas = LaidOutAtlas<StampSet>;
using TapAtlas = LaidOutAtlas<TapKernel>;

// Complete kernels as their source keeps them.
class SpreadAtlas final : public Atlas {
public:
    SpreadAtlas(const KernelSource& source, const KernelSet& set, const Control& control);
    const kernel::PointSpread& operator[](std::uint32_t kernel) const { return *kernels_[kernel]; }

private:
    std::vector<std::shared_ptr<const kernel::PointSpread>> kernels_;  // in the order of the set
};

}  // namespace petzval::device
