#include "kernel/model/radius_on_grid.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {

bool blurs_in_focus(const LensModel& lens) { return lens.reach_px(0) > 0.5; }

double radius_on_grid(double radius, bool blurs_in_focus) {
    if (std::abs(radius) < kInFocus) return 0;
    const double square = radius * radius, least = blurs_in_focus ? 0 : 0.25 + 0.55 * square;
    return std::copysign(std::sqrt(std::max(least, square - 0.25)), radius);
}

}  // namespace petzval::kernel
