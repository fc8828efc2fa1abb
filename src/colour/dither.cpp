#include "colour/dither.h"

#include <algorithm>
#include <cmath>

namespace petzval::colour {

double dither_pattern(int x, int y, int channel) {
    // 2^32/g, 2^32/g^2 and 2^32/3: unsigned arithmetic wraps, which is the fraction, without loss far out.
    constexpr std::uint32_t kStepX = 3242174889u, kStepY = 2447445414u, kStepChannel = 1431655765u;
    const std::uint32_t phase =
        std::uint32_t(x) * kStepX + std::uint32_t(y) * kStepY + std::uint32_t(channel) * kStepChannel;
    return double(phase) / 4294967296.0;
}

std::uint16_t dithered(double code, int largest, double u) {
    double noise = u - 0.5;  // uniform, half a code on either side
    if (code >= 1 && code <= largest - 1)
        // The inverse of the triangular distribution function on -1…1.
        noise = u < 0.5 ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u));
    return std::uint16_t(std::clamp(std::floor(code + noise + 0.5), 0.0, double(largest)));
}

}  // namespace petzval::colour
