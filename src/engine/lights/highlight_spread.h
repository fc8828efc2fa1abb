// Highlights spread with their complete kernels at full resolution, with the shadows of nearer things inside
// them.
#pragma once

#include "device/memory.h"
#include "engine/lights/highlights.h"
#include "engine/waist/engine.h"
#include "engine/waist/work.h"
#include "kernel/keep/bank.h"

#include <memory>
#include <vector>

namespace petzval::engine {

class SquareLens;

// Complete kernels of pixels and of squares of them.
class HighlightKernels final : public device::Memory::Thing {
public:
    explicit HighlightKernels(const Input& input);
    ~HighlightKernels() override;
    // fine: radius and place of the kernel as near to the highlight's as anybody can tell.
    std::shared_ptr<const kernel::PointSpread> of(const Highlight& h, kernel::FieldPosition field,
                                                  bool fine) const;
    std::size_t bytes() const override;

private:
    std::vector<std::unique_ptr<const SquareLens>> lenses_;
    std::vector<std::unique_ptr<const kernel::KernelBank>> banks_, fine_banks_;
};

// Adds to `out`, which is `rows` of the input, what every highlight sends there; `white` as in
// HighlightSplit. A tap is dimmed by the share of its rays that nearer samples stop: the pixel q of a sample
// at radius c_q lies on the ray from the highlight (s, c) through pupil point u = (q - s)/(c - c_q), so every
// nearer sample darkens a square of that side around u in the pupil. Returns what the taps took, shadows not
// counted.
Work spread_highlights(const Input& input, const HighlightKernels& kernels, const CocSamples& samples,
                       const std::vector<Highlight>& highlights, float white, const Rect& rows,
                       View<Rgba> out);

}  // namespace petzval::engine
