// The radius of the kernel that a disc takes on a grid.
#pragma once

#include "kernel/model/lens_model.h"

namespace petzval::kernel {

// In focus: discs of less leave a picture as it is. (Taps would give neighbours a thousandth of the light.)
constexpr double kInFocus = 0.1;

// True if the lens spreads light in focus over several cells.
bool blurs_in_focus(const LensModel& lens);

// A picture is already the mean of each pixel. Taps that are the parts of a disc in its cells take that mean
// a second time, and a disc within one cell would not spread at all. The taps of a disc of the returned
// radius blur a step best, wherever in a cell it lies: least squares, fitted to 0.03 cells. Where aberrations
// blur what is in focus, only the cell's own width is taken off. Radii are signed, in cells.
double radius_on_grid(double radius, bool blurs_in_focus);

}  // namespace petzval::kernel
