// Radial distortion as artists ask for it: what stands at r half diagonals from the middle of the display
// window is seen at r (1 + amount r^2).
#pragma once

#include <optional>

namespace petzval::optics {

// The radius that is seen at `target`; nothing where barrel distortion (amount < 0) shows nothing: its
// picture folds back on itself, and ends there, at 2/3 of sqrt(-1 / (3 amount)).
std::optional<double> undistorted(double target, double amount);

}  // namespace petzval::optics
