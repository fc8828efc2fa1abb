#include "optics/least_squares.h"

#include <cmath>

namespace petzval::optics {

std::vector<double> least_squares(std::vector<std::vector<double>> rows, std::vector<double> target) {
    const std::size_t count = rows.size(), unknowns = rows.front().size();
    std::vector<double> diagonal(unknowns);
    for (std::size_t k = 0; k < unknowns; ++k) {
        double norm = 0;
        for (std::size_t i = k; i < count; ++i) norm = std::hypot(norm, rows[i][k]);
        if (!(norm > 1e-12) || !std::isfinite(norm)) return {};
        if (rows[k][k] > 0) norm = -norm;
        // Reflect column k onto the axis; the reflector stays in its place below the diagonal.
        diagonal[k] = norm;
        rows[k][k] -= norm;
        double squared = 0;
        for (std::size_t i = k; i < count; ++i) squared += rows[i][k] * rows[i][k];
        const auto reflect = [&](auto&& entry) {
            double along = 0;
            for (std::size_t i = k; i < count; ++i) along += rows[i][k] * entry(i);
            for (std::size_t i = k; i < count; ++i) entry(i) -= 2 * along / squared * rows[i][k];
        };
        for (std::size_t j = k + 1; j < unknowns; ++j)
            reflect([&](std::size_t i) -> double& { return rows[i][j]; });
        reflect([&](std::size_t i) -> double& { return target[i]; });
    }
    std::vector<double> solution(unknowns);
    for (std::size_t k = unknowns; k-- > 0;) {
        double rest = target[k];
        for (std::size_t j = k + 1; j < unknowns; ++j) rest -= rows[k][j] * solution[j];
        solution[k] = rest / diagonal[k];
    }
    return solution;
}

}  // namespace petzval::optics
