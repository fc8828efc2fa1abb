// Least squares for many right-hand sides that share their unknowns' rows: factored once, solved often.
#pragma once

#include <vector>

namespace petzval::kernel {

class LinearFit {
public:
    // Householder QR of a matrix given by columns of one length. Requires: at least one.
    explicit LinearFit(std::vector<std::vector<double>> columns);
    std::size_t unknowns() const { return columns_.size(); }
    // False when there are fewer rows than columns, they depend on each other, or a number was not finite.
    bool solvable() const { return solvable_; }
    // Coefficients c that minimise |sum_k c_k column_k - target|. Requires: solvable().
    std::vector<double> solve(std::vector<double> target) const;

private:
    std::vector<std::vector<double>> columns_;  // below the diagonal the reflectors, above it R
    std::vector<double> diagonal_, reflector_square_;
    bool solvable_ = true;
};

}  // namespace petzval::kernel
