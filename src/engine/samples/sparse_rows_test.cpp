#include "engine/samples/sparse_rows.h"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 200, kHeight = 19;  // no whole number of words, nor of bands

bool has_one(int x, int y) { return y % 3 == 1 && (x % 7 == 3 || x == 63 || x == 64 || x == kWidth - 1); }

TEST(SparseRows, GivesEachPixelItsOwn) {
    SparseRows<int> rows(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        rows.find_row(y, [&](const auto& emit) {
            for (int x = 0; x < kWidth; ++x)
                if (has_one(x, y)) emit(x, x);
        });
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            int* const value = rows.at(x, y);
            ASSERT_EQ(value != nullptr, has_one(x, y)) << x << "," << y;
            if (value) {
                EXPECT_EQ((*value)++, x);
            }
        }
    EXPECT_EQ(*std::as_const(rows).at(64, 1), 65);
}

TEST(SparseRows, VisitsThoseOfARowFromTheLeft) {
    const SparseRows<int> rows(kWidth, kHeight, one_thread(), [&](int y, const auto& emit) {
        for (int x = 0; x < kWidth; ++x)
            if (has_one(x, y)) emit(x, x);
    });
    for (int y = 0; y < kHeight; ++y) {
        std::vector<int> expected, visited;
        for (int x = 0; x < kWidth; ++x)
            if (has_one(x, y)) expected.push_back(x);
        rows.for_each_in_row(y, [&](int x, int value) {
            EXPECT_EQ(value, x);
            visited.push_back(x);
        });
        EXPECT_EQ(visited, expected);
    }
    SparseRows<int>().for_each_in_row(7, [](int, int) { ADD_FAILURE(); });
}

TEST(SparseRows, OfNothingIsEmpty) { EXPECT_EQ(SparseRows<int>().at(5, 7), nullptr); }

}  // namespace
}  // namespace petzval::engine
