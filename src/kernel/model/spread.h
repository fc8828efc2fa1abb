// Finishing a kernel: energy and alpha.
#pragma once

#include "kernel/model/lens_model.h"

#include <memory>
#include <span>

namespace petzval::kernel {

// All light on the pixel of the source.
PointSpread single_pixel();

// The kernel at the mirrored place. Mirroring never leaves gaps: pixel 0 stays where it is.
PointSpread mirrored(const PointSpread& from, bool left_right, bool up_down);

// The sum of kernels, each times its share.
struct Share {
    std::shared_ptr<const PointSpread> kernel;
    float share = 1;
};
PointSpread mixed(std::span<const Share> shares);

// Drops border rows and columns that hold no light.
void trim(PointSpread& spread);

// The weight that blurs alpha: the luminance of the weights, and exactly the weights if they are neutral.
inline float alpha_of(const Rgba& w) { return w.r == w.g && w.g == w.b ? w.g : luminance(w); }

// Scales r, g, b to sum to 1 each, sets a to alpha_of them, and notes whether all are equal.
// Requires: each channel's sum is positive.
void normalise(PointSpread& spread);

}  // namespace petzval::kernel
