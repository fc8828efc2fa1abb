// Least squares for small, dense, full-rank problems.
#pragma once

#include <vector>

namespace petzval::optics {

// Coefficients c that minimise |sum_k c_k row[k] - target| over all rows, by Householder QR.
// Requires: rows.size() >= number of columns >= 1; all rows of one length. Empty when the columns depend on
// each other or a number is not finite.
std::vector<double> least_squares(std::vector<std::vector<double>> rows, std::vector<double> target);

}  // namespace petzval::optics
