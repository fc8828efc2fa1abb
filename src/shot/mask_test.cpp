#include "petzval/shot.h"

#include "files/test_exr.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

constexpr Rect kFrame{0, 0, 12, 8};

class Masks : public testing::Test {
protected:
    // The picture covers `data` of the frame.
    void write_picture(const Rect& data = kFrame) {
        const Plane grey(data.width(), data.height(), 0.2f), depth(data.width(), data.height(), 3.0f);
        ASSERT_TRUE(write_exr_planes(folder / "in.exr", {kFrame, data},
                                     {{"R", grey}, {"G", grey}, {"B", grey}, {"Z", depth}}));
    }
    Shot read(const std::string& mask) {
        ShotSource source;
        source.path = folder / "in.exr", source.mask = folder / mask;
        auto shot = read_shot(source);
        EXPECT_TRUE(shot) << shot.error().message;
        return shot ? std::move(*shot) : Shot{};
    }
    // The mask's value at a pixel of the frame.
    static float at(const Shot& shot, int x, int y) {
        return shot.mask(x - shot.mask_window.x0, y - shot.mask_window.y0);
    }
    TemporaryFolder folder;
};

TEST_F(Masks, AreZeroOutsideOfTheirPixelsAndGoOnBeyondTheFrame) {
    const Rect wider{-3, -2, 15, 10}, own{4, 2, 12, 8};
    write_picture(wider);
    ASSERT_TRUE(write_exr_planes(folder / "m.exr", {kFrame, own}, {{"roto", Plane(8, 6, 0.5f)}}));
    Shot shot = read("m.exr");
    EXPECT_EQ(at(shot, 5, 3), 0.5f);
    EXPECT_EQ(at(shot, 3, 3), 0);
    EXPECT_EQ(at(shot, 14, 9), 0.5f);
    EXPECT_EQ(at(shot, -3, -2), 0);
    ASSERT_TRUE(grow_to(shot, {-5, -4, 20, 12}));
    EXPECT_EQ(at(shot, 19, 11), 0.5f);
    shot.camera.focal_length_mm = shot.camera.sensor_width_mm = shot.camera.f_number =
        shot.camera.focus_distance_m = FoundNumber{2, ""};
    const auto lent = rendered(shot);
    ASSERT_TRUE(lent);
    EXPECT_EQ(lent->mask.width(), shot.colour.width());
    EXPECT_EQ(lent->mask(5 + 5, 3 + 4), 0.5f);
}

TEST_F(Masks, OutOfRangeAreCutWithAWarning) {
    using testing::Contains;
    write_picture();
    const auto warnings = [&](float value) {
        EXPECT_TRUE(write_exr_planes(folder / "m.exr", {kFrame, kFrame}, {{"roto", Plane(12, 8, value)}}));
        return read("m.exr").warnings;
    };
    EXPECT_THAT(warnings(1), testing::IsEmpty());
    EXPECT_THAT(warnings(255), Contains(HasSubstr("mask: has values from 255 to 255")));
    EXPECT_THAT(warnings(-1), Contains(HasSubstr("hardly changes")));
    EXPECT_THAT(warnings(1 / 255.0f), Contains(HasSubstr("at most 0.00392")));
}

TEST_F(Masks, AreTheChannelThatIsNamedElseAlphaElseLuminance) {
    write_picture();
    const Plane half(12, 8, 0.5f), one(12, 8, 1.0f), quarter(12, 8, 0.25f);
    ASSERT_TRUE(write_exr_planes(folder / "m.exr", Place::whole(kFrame),
                                 {{"R", half}, {"G", half}, {"B", half}, {"A", one}, {"id.x", quarter}}));
    EXPECT_NEAR(at(read("m.exr"), 1, 1), 0.5f, 1e-6f);
    EXPECT_EQ(at(read("m.exr:id.x"), 1, 1), 0.25f);
    EXPECT_EQ(at(read("m.exr:A"), 1, 1), 1);
    ASSERT_TRUE(write_exr_planes(folder / "a.exr", Place::whole(kFrame),
                                 {{"R", one}, {"G", one}, {"B", one}, {"A", quarter}}));
    EXPECT_EQ(at(read("a.exr"), 1, 1), 0.25f);
}

TEST_F(Masks, OfWholeNumbersAreSharesOfFullScale) {
    write_picture();
    PngPixels grey{12, 8, 1, 8, std::vector<std::uint16_t>(96, 51)};
    ASSERT_TRUE(write_png(folder / "m.png", grey));
    EXPECT_NEAR(at(read("m.png"), 1, 1), 0.2f, 1e-6f);
    PngPixels rgba{12, 8, 4, 8, {}};
    for (int i = 0; i < 96; ++i) rgba.samples.insert(rgba.samples.end(), {102, 204, 0, 51});
    ASSERT_TRUE(write_png(folder / "c.png", rgba));
    EXPECT_NEAR(at(read("c.png"), 1, 1), 0.2f, 1e-6f);
    EXPECT_NEAR(at(read("c.png:G"), 1, 1), 0.8f, 1e-6f);
}

TEST_F(Masks, OfAnotherFrameAreRefused) {
    write_picture();
    ASSERT_TRUE(write_exr_planes(folder / "m.exr", Place::whole({0, 0, 13, 8}), {{"A", Plane(13, 8, 1.0f)}}));
    ShotSource source;
    source.path = folder / "in.exr", source.mask = folder / "m.exr";
    const auto refused = read_shot(source);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("shot.mask"));
    EXPECT_THAT(refused.error().message, HasSubstr("display window"));
}

}  // namespace
}  // namespace petzval
