// Complete kernels of highlights, on pixels: of one pixel and of squares of them.
#pragma once

#include "device/kernels.h"
#include "device/memory.h"
#include "engine/lights/highlights.h"
#include "engine/waist/engine.h"
#include "kernel/keep/bank.h"
#include "kernel/keep/kernel_cache.h"

#include <deque>
#include <vector>

namespace petzval::engine {

// The parts of a highlight's kernel that are bright enough to be seen, and must be precise.
enum class Seen : int { Nothing, Disc, DiscAndRim };

// Kernels of highlights. An ask's piece holds the size of the square and the bank of points, or the part of a
// pixel; step and zone are those of that bank.
class HighlightKernels final : public device::KernelSource, public device::Memory::Thing {
public:
    explicit HighlightKernels(const EngineView& input);

    device::KernelAsk ask(const Highlight& h, kernel::FieldPosition field, Seen seen) const;
    std::vector<Made> make(std::span<const device::KernelAsk> asks) const override;
    std::size_t bytes() const override;

private:
    kernel::PointSpread of_part(const device::KernelAsk& ask) const;
    std::size_t bank_for(float radius_px, Seen seen) const;
    std::shared_ptr<const kernel::PointSpread> of_point(const device::KernelAsk& ask) const;

    LensOnPicture lens_;
    bool knows_parts_;
    std::deque<kernel::KernelBank> points_;                   // by Seen; then of Nothing, on levels from 1 on
    mutable kernel::KernelCache<device::KernelAsk> squares_;  // of more than one pixel, or of a part of one
};

}  // namespace petzval::engine
