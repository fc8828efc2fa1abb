// Complete kernels of highlights: of pixels and of squares of them, at full resolution.
#pragma once

#include "device/kernels.h"
#include "device/memory.h"
#include "engine/lights/highlights.h"
#include "engine/waist/engine.h"
#include "kernel/keep/bank.h"
#include "kernel/keep/kernel_cache.h"

#include <vector>

namespace petzval::engine {

// Kernels of highlights. An ask's piece holds the size of the square and the precision of radius and place;
// step and zone are those of the bank of points of that precision.
class HighlightKernels final : public device::KernelSource, public device::Memory::Thing {
public:
    explicit HighlightKernels(const EngineView& input);

    // fine: radius and place of the kernel as close to the highlight's as is visible.
    device::KernelAsk ask(const Highlight& h, kernel::FieldPosition field, bool fine) const;
    std::vector<Made> make(std::span<const device::KernelAsk> asks) const override;
    std::size_t bytes() const override;

private:
    const kernel::KernelBank& points(bool fine) const { return fine ? fine_points_ : points_; }

    kernel::KernelBank points_, fine_points_;
    mutable kernel::KernelCache<device::KernelAsk> squares_;  // of more than one pixel
};

}  // namespace petzval::engine
