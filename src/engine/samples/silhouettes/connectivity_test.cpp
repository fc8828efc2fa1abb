#include "engine/samples/silhouettes/connectivity.h"

#include "base/parallel.h"

#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// Each is true if that pixel of a row is connected to the next one.
std::vector<bool> connected_in(std::span<const float> radii) {
    Plane coc(int(radii.size()), 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < coc.width(); ++x) coc(x, y) = radii[std::size_t(x)];
    const auto connected = connections(coc, one_thread());
    std::vector<bool> found;
    for (int x = 0; x + 1 < coc.width(); ++x) found.push_back(connected(x, 1) & kRight);
    return found;
}

TEST(Connections, ContinueASlope) {
    const std::vector<float> floor{0, 2, 4, 6.4f, 9, 12};
    EXPECT_EQ(connected_in(floor), std::vector<bool>(5, true));
}

TEST(Connections, DoNotCrossASliver) {
    const std::vector<float> sliver{-15, -15, -15, 0, 9, 9, 9};
    EXPECT_EQ(connected_in(sliver), (std::vector<bool>{true, true, false, false, true, true}));
}

// Depths of 8 bits step by so much.
TEST(Connections, CrossTheStepsOfRoundedDepths) {
    const std::vector<float> rounded{0, 0, 0.6f, 0.6f, 1.2f, 1.8f, 1.8f};
    EXPECT_EQ(connected_in(rounded), std::vector<bool>(6, true));
    const std::vector<float> exact{0, 0.01f, 0.02f, 0.62f, 0.63f};
    EXPECT_EQ(connected_in(exact), (std::vector<bool>{true, true, false, true}));
    const std::vector<float> cards{0, 0, 0.6f, 0.6f, 1.4f, 1.4f};
    EXPECT_EQ(connected_in(cards), (std::vector<bool>{true, false, true, false, true}));
}

}  // namespace
}  // namespace petzval::engine
