#include "device/cpu/cover.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device {
namespace {

constexpr int kSide = 37, kStride = kSide + CoveredCells::kSpill;

std::vector<float> covered(std::span<const engine::SeenCaster> casters, float per_radius) {
    std::vector<float> cells(std::size_t(kStride) * kSide, 0);
    cover({cells.data(), kStride, kSide, per_radius}, casters);
    return cells;
}

float overlap(float at, float side, int cell) {
    return std::max(0.0f,
                    std::min(at + 0.5f * side, float(cell + 1)) - std::max(at - 0.5f * side, float(cell)));
}

// Narrower than a cell, wider than a register, and partly or wholly outside.
TEST(Cover, ASquareCoversEachCellByWhatLiesInIt) {
    for (const float per_radius : {0.5f * kSide, -0.5f * kSide})
        for (const float side : {0.02f, 0.05f, 0.3f, 1.7f})
            for (const float u : {-1.2f, -0.31f, 0.0f, 0.64f, 1.01f}) {
                const float v = 0.4f * u + 0.1f, middle = 0.5f * kSide, cells = side * 0.5f * kSide;
                const engine::SeenCaster caster{u, v, side, side, 0, 0.5f};
                const std::vector<float> found = covered({&caster, 1}, per_radius);
                for (int y = 0; y < kSide; ++y)
                    for (int x = 0; x < kSide; ++x)
                        ASSERT_NEAR(found[std::size_t(y * kStride + x)],
                                    0.5f * overlap(middle + u * per_radius, cells, x) *
                                        overlap(middle + v * per_radius, cells, y),
                                    2e-5f)
                            << side << " at " << u << ", cell " << x << "," << y;
            }
}

TEST(Cover, BlurSpreadsASquareAndKeepsItsArea) {
    for (const float blur : {0.1f, 0.5f, 0.9f}) {
        const engine::SeenCaster caster{0.03f, -0.02f, 0.5f, 0.5f, blur, 1};
        const std::vector<float> found = covered({&caster, 1}, 0.5f * kSide);
        double sum = 0;
        float touched = 0;
        for (const float cell : found) sum += double(cell), touched += cell > 0 ? 1.0f : 0.0f;
        const float cells = 0.5f * kSide * 0.5f, wide = cells + blur * 0.5f * kSide;
        EXPECT_NEAR(sum, double(cells * cells), 1e-3);
        EXPECT_GE(touched, wide * wide);
        EXPECT_LE(touched, (wide + 2) * (wide + 2));
    }
}

TEST(Cover, RectanglesAddUp) {
    const engine::SeenCaster both[] = {{-0.2f, 0.1f, 0.4f, 0.9f, 0, 1},
                                       {0.1f, 0.2f, 0.6f, 0.1f, 0.2f, 0.25f}};
    const std::vector<float> first = covered({both, 1}, 10), second = covered({both + 1, 1}, 10),
                             sum = covered(both, 10);
    for (std::size_t i = 0; i < sum.size(); ++i) EXPECT_FLOAT_EQ(sum[i], first[i] + second[i]);
}

TEST(Cover, WhatIsNotCoveredIsOpen) {
    std::vector<float> cells(kSide), open(kSide + 1, 7.0f);
    for (std::size_t i = 0; i < kSide; ++i) cells[i] = 0.0625f * float(i % 20);
    find_open(cells, open.data());
    for (std::size_t i = 0; i < kSide; ++i)
        EXPECT_EQ(open[i], std::max(0.0f, 1 - 0.0625f * float(i % 20))) << i;
    EXPECT_EQ(open[kSide], 7.0f) << "beyond the row";
}

}  // namespace
}  // namespace petzval::device
