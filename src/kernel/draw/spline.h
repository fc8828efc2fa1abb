// Natural cubic spline through given points, continued straight beyond them.
#pragma once

#include <vector>

namespace petzval::kernel {

// One point: a constant. Two: a straight line.
class CubicSpline {
public:
    // Requires: x rising, x and y of the same size >= 1.
    CubicSpline(std::vector<double> x, std::vector<double> y);
    double operator()(double x) const;

private:
    std::vector<double> x_, y_, bend_;  // bend: second derivative at the points, 0 at both ends
};

}  // namespace petzval::kernel
