#include "kernel/draw/linear_fit.h"

#include <cmath>

namespace petzval::kernel {
namespace {

// Mirrors `values` at the plane across a reflector, from entry `first` on.
void reflect(const std::vector<double>& reflector, double square, std::size_t first,
             std::vector<double>& values) {
    double along = 0;
    for (std::size_t i = first; i < values.size(); ++i) along += reflector[i] * values[i];
    const double factor = 2 * along / square;
    for (std::size_t i = first; i < values.size(); ++i) values[i] -= factor * reflector[i];
}

}  // namespace

LinearFit::LinearFit(std::vector<std::vector<double>> columns)
    : columns_(std::move(columns)), solvable_(columns_[0].size() >= columns_.size()) {
    for (std::size_t k = 0; k < columns_.size() && solvable_; ++k) {
        double square = 0;
        for (std::size_t i = k; i < columns_[k].size(); ++i) square += columns_[k][i] * columns_[k][i];
        const double norm = columns_[k][k] > 0 ? -std::sqrt(square) : std::sqrt(square);
        if (!(square > 1e-24) || !std::isfinite(square)) solvable_ = false;
        diagonal_.push_back(norm);
        // |v - norm e|^2 = 2 norm (norm - v_k)
        reflector_square_.push_back(2 * norm * (norm - columns_[k][k]));
        columns_[k][k] -= norm;
        for (std::size_t j = k + 1; j < columns_.size() && solvable_; ++j)
            reflect(columns_[k], reflector_square_[k], k, columns_[j]);
    }
}

std::vector<double> LinearFit::solve(std::vector<double> target) const {
    const std::size_t count = columns_.size();
    for (std::size_t k = 0; k < count; ++k) reflect(columns_[k], reflector_square_[k], k, target);
    std::vector<double> solution(count);
    for (std::size_t k = count; k-- > 0;) {
        double rest = target[k];
        for (std::size_t j = k + 1; j < count; ++j) rest -= columns_[j][k] * solution[j];
        solution[k] = rest / diagonal_[k];
    }
    return solution;
}

}  // namespace petzval::kernel
