// Interpolation between traced wavelengths.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace petzval::kernel {

// The three traced wavelengths nearest to one, and the weights of the parabola through them over
// 1/wavelength^2.
struct Parabola {
    std::size_t first = 0;
    double weight[3] = {1, 0, 0};

    Parabola(const std::vector<double>& wavelengths_nm, double wavelength_nm) {
        if (wavelengths_nm.size() < 3) return;
        while (first + 3 < wavelengths_nm.size() && std::abs(wavelengths_nm[first + 3] - wavelength_nm) <
                                                        std::abs(wavelengths_nm[first] - wavelength_nm))
            ++first;
        const auto axis = [](double nm) { return 1e6 / (nm * nm); };
        // Values beyond the traced range are those of its end.
        const double x = axis(std::clamp(wavelength_nm, wavelengths_nm.front(), wavelengths_nm.back()));
        for (std::size_t i = 0; i < 3; ++i) {
            weight[i] = 1;
            for (std::size_t k = 0; k < 3; ++k) {
                const double xi = axis(wavelengths_nm[first + i]), xk = axis(wavelengths_nm[first + k]);
                if (k != i) weight[i] *= (x - xk) / (xi - xk);
            }
        }
    }
};

}  // namespace petzval::kernel
