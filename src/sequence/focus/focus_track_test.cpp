#include "petzval/focus_track.h"

#include "petzval/track.h"

#include "base/temporary_folder.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(FocusTrack, PicksAreOrderedByFrameAndOneFrameHasOne) {
    const auto picks = in_order({{9, {1, 1}}, {-2, {2, 2}}, {4, {3, 3}}});
    ASSERT_TRUE(picks);
    EXPECT_EQ((std::vector{(*picks)[0].frame, (*picks)[1].frame, (*picks)[2].frame}),
              (std::vector{-2, 4, 9}));
    EXPECT_EQ(pixel_at(*picks, 4).x, 3);
    const auto twice = in_order({{4, {1, 1}}, {2, {5, 5}}, {4, {2, 2}}});
    ASSERT_FALSE(twice);
    EXPECT_EQ(twice.error().message, "focus.picks: frame 4 twice; a pixel without a frame stands alone");
    EXPECT_TRUE(in_order({})->empty());
}

TEST(FocusTrack, PixelsMoveEvenlyBetweenPicksAndStayOutside) {
    const std::vector<FocusPick> picks{{10, {100, 50}}, {20, {200, 40}}, {21, {0, 0}}};
    const auto at = [&](int frame) {
        const PixelPosition p = pixel_at(picks, frame);
        return std::pair(p.x, p.y);
    };
    EXPECT_EQ(at(1), std::pair(100, 50));
    EXPECT_EQ(at(10), std::pair(100, 50));
    EXPECT_EQ(at(13), std::pair(130, 47));
    EXPECT_EQ(at(20), std::pair(200, 40));
    EXPECT_EQ(at(99), std::pair(0, 0));
}

TEST(FocusTrack, SmoothingIsEvenInDioptresAndKeepsWhatIsSteady) {
    std::vector<FocusKey> keys;
    for (int frame = 0; frame < 41; ++frame) keys.push_back({frame, 1 / (0.1 + 0.01 * frame)});
    const auto same = smoothed(keys, 0);
    for (std::size_t i = 0; i < keys.size(); ++i) EXPECT_EQ(same[i].distance_m, keys[i].distance_m);
    EXPECT_NEAR(smoothed(keys, 3)[20].distance_m, keys[20].distance_m, 1e-9) << "a straight line stays one";
    keys[20].distance_m = 100;  // a hair that the pixel missed for one frame
    const auto smooth = smoothed(keys, 3);
    EXPECT_NEAR(1 / smooth[20].distance_m, 0.3, 0.05);
    for (FocusKey& key : keys) key.distance_m = kInfinity;
    EXPECT_EQ(smoothed(keys, 3)[7].distance_m, kInfinity);
}

TEST(FocusTrack, IsReadBackAsItWas) {
    const std::vector<FocusKey> keys{{-3, 0.123456789}, {1, 4}, {2, kInfinity}};
    const test::TemporaryFolder folder;
    std::ofstream(folder / "focus.csv") << track_csv(keys);
    const auto track = Track::read(folder / "focus.csv");
    ASSERT_TRUE(track) << track.error().message;
    for (const FocusKey& key : keys)
        EXPECT_DOUBLE_EQ(*track->at(key.frame).camera.focus_distance_m, key.distance_m);
}

TEST(FocusTrack, ThePlotNamesDistancesAndFrames) {
    const std::vector<FocusKey> keys{{1001, 1}, {1011, 4}, {1021, kInfinity}};
    const std::string plot = focus_plot(keys, smoothed(keys, 2));
    for (const char* word : {">1 m<", ">infinity<", ">1001<", "</svg>"}) EXPECT_THAT(plot, HasSubstr(word));
    EXPECT_THAT(plot, Not(HasSubstr("nan")));
    EXPECT_THAT(plot, Not(HasSubstr("inf,")));
    const std::vector<FocusKey> one{{7, 2.5}};
    EXPECT_THAT(focus_plot(one, one), Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace petzval
