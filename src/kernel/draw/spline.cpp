#include "kernel/draw/spline.h"

#include "base/check.h"

#include <algorithm>

namespace petzval::kernel {

CubicSpline::CubicSpline(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)), bend_(x_.size(), 0.0) {
    PETZVAL_CHECK(!x_.empty() && x_.size() == y_.size());
    // The slopes of neighbouring pieces agree: a tridiagonal system, solved by elimination.
    std::vector<double> upper(x_.size(), 0.0);
    for (std::size_t i = 1; i + 1 < x_.size(); ++i) {
        const double left = x_[i] - x_[i - 1], right = x_[i + 1] - x_[i];
        const double kink = (y_[i + 1] - y_[i]) / right - (y_[i] - y_[i - 1]) / left;
        const double pivot = 2 * (left + right) - left * upper[i - 1];
        upper[i] = right / pivot;
        bend_[i] = (6 * kink - left * bend_[i - 1]) / pivot;
    }
    for (std::size_t i = x_.size() - 1; i-- > 1;) bend_[i] -= upper[i] * bend_[i + 1];
}

double CubicSpline::operator()(double x) const {
    if (x_.size() == 1) return y_[0];
    const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
    const std::size_t k = std::size_t(above - x_.begin());  // piece from k - 1 to k
    const double width = x_[k] - x_[k - 1];
    const double chord = (y_[k] - y_[k - 1]) / width;
    if (x < x_[0]) return y_[0] + (x - x_[0]) * (chord - width * bend_[1] / 6);
    if (x > x_.back()) return y_.back() + (x - x_.back()) * (chord + width * bend_[k - 1] / 6);
    const double p = (x_[k] - x) / width, q = 1 - p;
    return p * y_[k - 1] + q * y_[k] +
           width * width / 6 * ((p * p * p - p) * bend_[k - 1] + (q * q * q - q) * bend_[k]);
}

}  // namespace petzval::kernel
