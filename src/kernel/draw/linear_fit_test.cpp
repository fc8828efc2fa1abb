#include "kernel/draw/linear_fit.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

TEST(LinearFit, FindsThePolynomialThatMadeTheValues) {
    std::vector<std::vector<double>> columns(4);
    std::vector<double> first, second;
    for (int i = 0; i < 20; ++i) {
        const double x = -1 + i / 9.5;
        for (std::size_t k = 0; k < 4; ++k) columns[k].push_back(std::pow(x, double(k)));
        first.push_back(2 - x + 0.5 * x * x * x), second.push_back(3 * x * x);
    }
    const LinearFit fit(columns);
    ASSERT_TRUE(fit.solvable());
    const std::vector<double> p = fit.solve(first), q = fit.solve(second);
    const double expected_p[] = {2, -1, 0, 0.5}, expected_q[] = {0, 0, 3, 0};
    for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(p[k], expected_p[k], 1e-12);
        EXPECT_NEAR(q[k], expected_q[k], 1e-12);
    }
}

TEST(LinearFit, MissesByLeastSquares) { EXPECT_NEAR(LinearFit({{1, 1, 1}}).solve({0, 3, 6})[0], 3, 1e-12); }

TEST(LinearFit, KnowsWhatItCannotSolve) {
    EXPECT_FALSE(LinearFit({{1, 1, 1}, {2, 2, 2}}).solvable());
    EXPECT_FALSE(LinearFit({{1}, {2}}).solvable());
    EXPECT_FALSE(LinearFit({{1, std::nan("")}}).solvable());
}

}  // namespace
}  // namespace petzval::kernel
