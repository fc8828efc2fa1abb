// The transfer curve of sRGB (IEC 61966-2-1), light to code; both 0…1, T float or double.
#pragma once

#include <cmath>

namespace petzval {

// Requires: linear >= 0.
template <typename T>
T srgb_code(T linear) {
    return linear <= T(0.0031308) ? T(12.92) * linear : T(1.055) * std::pow(linear, T(1) / T(2.4)) - T(0.055);
}

}  // namespace petzval
