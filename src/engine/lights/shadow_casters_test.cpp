#include "engine/lights/shadow_casters.h"

#include "base/parallel.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 48, kHeight = 32;

// Things in front of focus, sloping and in part transparent, over a background behind it.
CocSamples twigs() {
    CocSamples all;
    all.width = kWidth;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            all.first.push_back(all.samples.size());
            const float coc_px = -1.5f - 0.9f * float(x) - 0.03f * float(y);
            const float coverage = (x + y) % 3 == 0 ? 0.4f : (x * y) % 5 == 1 ? 1.0f : 0;
            if (coverage > 0) all.samples.push_back({{0, 0, 0, coverage}, coc_px, coc_px});
            all.samples.push_back({{0, 0, 0, 1}, 20, 20});
        }
    all.first.push_back(all.samples.size());
    return all;
}

// Area covered by squares of a view up to a radius, in pixels.
double covered(const ShadowCasters& casters, int view, float up_to_px) {
    double sum = 0;
    for (int by = 0; by * ShadowCasters::kBlock < kHeight; ++by)
        for (int bx = 0; bx * ShadowCasters::kBlock < kWidth; ++bx)
            for (const Caster& c : casters.of_block(view, bx, by))
                if (c.coc_px <= up_to_px) sum += double(c.coverage) * double(c.size * c.size);
    return sum;
}

TEST(ShadowCasters, ViewsCoverAsMuchUpToEveryRadiusAtWhichOneMayEnd) {
    const ShadowCasters casters(twigs(), one_thread());
    for (const float end : {-2.0f, -4.0f, -8.0f, -16.0f, -32.0f}) {
        const double fine = covered(casters, 0, end);
        EXPECT_GT(fine, 10);
        for (int view = 1; view < ShadowCasters::kViews; ++view)
            EXPECT_NEAR(covered(casters, view, end), fine, 1e-3 * fine) << "view " << view << " to " << end;
    }
}

TEST(ShadowCasters, CoarserViewsHaveLargerAndFewerSquares) {
    const ShadowCasters casters(twigs(), one_thread());
    std::size_t before = 0;
    for (int view = 0; view < ShadowCasters::kViews; ++view) {
        const auto squares = casters.of_block(view, 2, 0);
        for (const Caster& c : squares) EXPECT_GE(c.size, float(1 << view));
        if (view > 0) {
            EXPECT_LT(squares.size(), before);
        }
        before = squares.size();
    }
}

TEST(ShadowCasters, AViewEndsWhereItsSquaresWouldBeWiderThanATap) {
    for (const float highlight : {-40.0f, 5.0f, 30.0f, 100.0f})
        for (int view = 1; view < ShadowCasters::kViews; ++view) {
            const float end = ShadowCasters::end_of_view(view, highlight);
            EXPECT_EQ(std::exp2(std::round(std::log2(-end))), -end) << "where no square is cut";
            if (end < highlight) {
                EXPECT_LE(float(1 << view) * std::abs(highlight) / (highlight - end), 1.0001f)
                    << view << " of " << highlight;
            }
        }
}

}  // namespace
}  // namespace petzval::engine
