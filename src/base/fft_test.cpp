#include "base/fft.h"

#include "base/parallel.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using Complex = std::complex<float>;

// Numbers without a pattern.
std::vector<Complex> field_of(int n) {
    std::vector<Complex> field;
    for (int i = 0; i < n * n; ++i)
        field.emplace_back(float(std::sin(12.9898 * i + double(i) * i)), float(std::cos(78.233 * i + 1)));
    return field;
}

// One entry of the forward transform, by its definition.
std::complex<double> entry(const std::vector<Complex>& field, int n, int column, int row) {
    std::complex<double> sum = 0;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            sum += std::complex<double>(field[std::size_t(y * n + x)]) *
                   std::polar(1.0, -2 * std::numbers::pi * ((column * x + row * y) % n) / n);
    return sum;
}

// 64 and 256 points are an even number of stages, 32 and 128 an odd one; 128 and more are in several parts.
TEST(Fft, IsTheSumOfTheDefinition) {
    for (const int n : {16, 32, 64, 128, 256}) {
        const std::vector<Complex> before = field_of(n);
        std::vector<Complex> after = before;
        fft_square(after, Fft(n), false, one_thread());
        for (const auto& [column, row] : {std::pair{0, 0}, {1, 0}, {0, 1}, {n / 2, 3}, {n - 1, n - 5}}) {
            const std::complex<double> got(after[std::size_t(row * n + column)]);
            EXPECT_NEAR(std::abs(got - entry(before, n, column, row)), 0, 1e-5 * n * n) << n << ' ' << column;
        }
    }
}

TEST(Fft, InverseUndoesForward) {
    for (const int n : {16, 128}) {
        const std::vector<Complex> before = field_of(n);
        std::vector<Complex> after = before;
        fft_square(after, Fft(n), false, one_thread());
        fft_square(after, Fft(n), true, one_thread());
        for (std::size_t i = 0; i < before.size(); ++i)
            ASSERT_NEAR(std::abs(after[i] - before[i]), 0, 1e-5f) << n;
    }
}

TEST(Fft, ColumnsWithinReachHaveTheBitsOfAll) {
    const int n = 128;
    for (const int reach : {0, 15, 16, 40, 63}) {
        std::vector<Complex> some = field_of(n), all = field_of(n);
        fft_square(some, Fft(n), false, one_thread(), reach);
        fft_square(all, Fft(n), false, one_thread());
        for (int y = 0; y < n; ++y)
            for (int x = -reach; x <= reach; ++x) {
                const auto at = std::size_t(y * n + (x & (n - 1)));
                ASSERT_EQ(some[at], all[at]) << reach << ' ' << x;
            }
    }
}

}  // namespace
}  // namespace petzval
