#include "optics/distortion.h"

#include "petzval/place.h"

#include <algorithm>
#include <cmath>

namespace petzval {
namespace optics {

// r (1 + amount r^2) = target, by Newton's method from the target itself.
std::optional<double> undistorted(double target, double amount) {
    const double farthest = amount < 0 ? std::sqrt(-1 / (3 * amount)) : 2 * target;
    if (amount < 0 && target > 2.0 / 3 * farthest) return std::nullopt;
    double r = std::min(target, farthest);
    for (int i = 0; i < 12; ++i) {
        const double slope = std::max(1e-3, 1 + 3 * amount * r * r);
        r = std::clamp(r - (r * (1 + amount * r * r) - target) / slope, 0.0, farthest);
    }
    return r;
}

}  // namespace optics

int distortion_reach_px(const Place& place, double amount) {
    const double half_diagonal_px = 1 / place.field().field_per_px;
    if (const auto corner = optics::undistorted(1, amount))
        return int(std::ceil(half_diagonal_px * std::abs(*corner - 1)));
    // A third of the last circle that is seen.
    return int(std::ceil(half_diagonal_px * std::sqrt(-1 / (3 * amount)) / 3));
}

}  // namespace petzval
