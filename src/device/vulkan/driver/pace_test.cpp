#include "device/vulkan/driver/pace.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

// Devices from 10^8 multiply-adds a second, slower than any real one, to 10^14; parts of the picture are up
// to five times slower than others.
TEST(Pace, NoSubmissionTakesTwoSecondsOnADeviceOfAnySpeed) {
    for (double per_s = 1e8; per_s < 1e14; per_s *= 3) {
        Pace pace;
        double longest_s = 0;
        unsigned state = 1;
        for (int i = 0; i < 200; ++i) {
            state = state * 1664525u + 1013904223u;
            const double slower = i == 0 ? 1 : 1 + 4 * double(state / 65536u % 1000) / 1000;
            const double seconds = double(pace.most()) * slower / per_s;
            longest_s = std::max(longest_s, seconds);
            pace.took(pace.most(), seconds);
        }
        EXPECT_LT(longest_s, 2) << per_s;
    }
}

TEST(Pace, FindsHowMuchADeviceDoesInItsTime) {
    Pace pace;
    constexpr double kPerSecond = 1e9;
    for (int i = 0; i < 3; ++i) pace.took(pace.most(), double(pace.most()) / kPerSecond);
    EXPECT_NEAR(double(pace.most()), kPerSecond * Pace::kWantedSeconds, 1e3);
    pace.took(1000, 1e-9);
    EXPECT_LE(pace.most(), Pace::kMost);
    pace.took(0, 1);
    pace.took(pace.most(), 1e9);
    EXPECT_EQ(pace.most(), Pace::kLeast) << "however slow it is, something is drawn";
}

}  // namespace
}  // namespace petzval::device::vulkan
