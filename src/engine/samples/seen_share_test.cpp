#include "engine/samples/seen_share.h"

#include <array>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

CocSample sample(float alpha, float coc_px) { return {{alpha, alpha, alpha, alpha}, coc_px, coc_px}; }

TEST(IsBeside, ThereIsRoomForWhatTheNearerOnesLeave) {
    EXPECT_TRUE(is_beside(std::array{sample(0.6f, -8), sample(0.4f, 5)}));
    EXPECT_FALSE(is_beside(std::array{sample(0.6f, -8), sample(0.5f, 5)}));
}

// A lamp's light and the surface behind an edge have one radius; the surface's is a mean that rounds.
TEST(IsBeside, TheLastDigitsOfARadiusTakeNoRoom) {
    for (const float rounded : {-1e-4f, 0.0f, 1e-4f}) {
        const std::array samples{sample(0.97f, -8), sample(1, 5 + rounded), sample(0, 5)};
        EXPECT_TRUE(is_beside(samples)) << rounded;
    }
}

}  // namespace
}  // namespace petzval::engine
