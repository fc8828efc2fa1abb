// Complete kernels of highlights: of pixels and of squares of them, at full resolution.
#pragma once

#include "device/kernels.h"
#include "device/memory.h"
#include "engine/lights/highlights.h"
#include "engine/waist/engine.h"
#include "kernel/keep/bank.h"

#include <memory>
#include <vector>

namespace petzval::engine {

class SquareLens;

// Kernels of highlights. An ask's piece holds the size of the square and the precision of radius and place;
// step and zone are those of the named bank.
class HighlightKernels final : public device::KernelSource, public device::Memory::Thing {
public:
    explicit HighlightKernels(const EngineView& input);
    ~HighlightKernels() override;

    // fine: radius and place of the kernel as close to the highlight's as is visible.
    device::KernelAsk ask(const Highlight& h, kernel::FieldPosition field, bool fine) const;
    std::vector<Made> make(std::span<const device::KernelAsk> asks) const override;
    std::size_t bytes() const override;

private:
    std::vector<std::unique_ptr<const SquareLens>> lenses_;
    std::vector<std::unique_ptr<const kernel::KernelBank>> banks_;  // by piece
};

}  // namespace petzval::engine
