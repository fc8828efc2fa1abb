#include "petzval/files.h"

#include "files/test_exr.h"

#include <cmath>
#include <gmock/gmock.h>

#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

namespace petzval {
namespace {

using test::QuickPart;
using test::TemporaryFolder;
using test::write_quick_exr;
using testing::Contains;
using testing::HasSubstr;

const Rect kFrame{0, 0, 8, 6};

Result<DepthOfFile> depth_in(const std::string& path, const Place& place = Place::whole(kFrame)) {
    ReadOptions options;
    options.depth_file = path;
    return read_depth_file(options, place);
}

QuickPart depth_part(const Rect& window) {
    return {"", "", window, {{"Z", Imf::FLOAT, [](int x, int y) { return 1 + x + 10 * y; }}}};
}

TEST(DepthFile, CoversTheDataWindowOfAHostsPicture) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "z.exr", kFrame, {depth_part({0, 0, 6, 6})});
    const auto read = depth_in(folder / "z.exr", {kFrame, {2, 1, 8, 4}, 1});
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->depth.width(), 6);
    ASSERT_EQ(read->depth.height(), 3);
    EXPECT_EQ(read->depth(0, 0), 1 + 2 + 10 * 1);
    EXPECT_TRUE(std::isinf(read->depth(5, 0))) << "the file has no pixel there";
    EXPECT_FALSE(read->is_share);
}

TEST(DepthFile, OfAnotherSizeIsStretchedOverTheFrame) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "z.exr", {0, 0, 4, 3}, {depth_part({0, 0, 4, 3})});
    const auto read = depth_in(folder / "z.exr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->depth(1, 1), 1);
    EXPECT_EQ(read->depth(2, 5), 1 + 1 + 10 * 2);
    EXPECT_THAT(read->detected, Contains(HasSubstr("4 x 3 for 8 x 6")));
}

TEST(DepthFile, LiesInTheFrameWhereverItsWindowsBegin) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "z.exr", kFrame.moved(100, -20), {depth_part({102, -19, 106, -17})});
    const auto read = depth_in(folder / "z.exr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->depth(2, 1), 1 + 102 - 190);
    EXPECT_TRUE(std::isinf(read->depth(1, 1)));
}

TEST(DepthFile, OfWholeNumbersIsAShare) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_png(folder / "z.png", {2, 1, 1, 8, {0, 255}}));
    const auto read = depth_in(folder / "z.png");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->is_share);
    EXPECT_EQ(read->depth(0, 0), 0);
    EXPECT_NEAR(read->depth(3, 0), 0.375, 1e-6) << "(3 + 0.5) * 2 / 8 - 0.5: a line between the values";
    EXPECT_EQ(read->depth(7, 5), 1);
}

TEST(DepthFile, OfAnotherShapeIsStretchedWithAWarning) {
    const TemporaryFolder folder;
    write_quick_exr(folder / "turned.exr", {0, 0, 6, 8}, {depth_part({0, 0, 6, 8})});
    ASSERT_TRUE(write_png(folder / "turned.png", {3, 4, 1, 8, std::vector<std::uint16_t>(12, 9)}));
    for (const char* name : {"turned.exr", "turned.png"}) {
        const auto read = depth_in(folder / name);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_THAT(read->warnings, Contains(HasSubstr("another shape"))) << name;
    }
    ASSERT_TRUE(write_png(folder / "small.png", {4, 3, 1, 8, std::vector<std::uint16_t>(12, 9)}));
    const auto small = depth_in(folder / "small.png");
    ASSERT_TRUE(small);
    EXPECT_TRUE(small->warnings.empty());
}

TEST(DepthFile, OfColoursIsReadFromRedWithAWarning) {
    const TemporaryFolder folder;
    std::vector<std::uint16_t> false_colours, grey_as_jpeg;
    for (int i = 0; i < 12; ++i) {
        false_colours.insert(false_colours.end(), {std::uint16_t(20 * i), 90, 200});
        for (const int off : {1, 0, 3}) grey_as_jpeg.push_back(std::uint16_t(20 * i + off));
    }
    ASSERT_TRUE(write_png(folder / "false.png", {4, 3, 3, 8, false_colours}));
    ASSERT_TRUE(write_png(folder / "grey.png", {4, 3, 3, 8, grey_as_jpeg}));
    const auto coloured = depth_in(folder / "false.png"), grey = depth_in(folder / "grey.png");
    ASSERT_TRUE(coloured && grey);
    EXPECT_THAT(coloured->warnings, Contains(HasSubstr("has colours")));
    EXPECT_TRUE(grey->warnings.empty());
}

TEST(DepthFile, OfDeepSamplesIsTheirFrontView) {
    const TemporaryFolder folder;
    const std::vector<DeepSample> samples{
        {{0, 0, 0, 0.1f}, 1, 1}, {{0, 1, 0, 1}, 9, 9}, {{1, 0, 0, 1}, 4, 4}};
    ASSERT_TRUE(write_deep_exr(folder / "deep.exr", Place::whole({0, 0, 2, 1}),
                               DeepPicture(2, 1, {0, 2, 3}, samples)));
    const auto read = depth_in(folder / "deep.exr", Place::whole({0, 0, 2, 1}));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->depth(0, 0), 9) << "thin fog hides no wall";
    EXPECT_EQ(read->depth(1, 0), 4);
}

TEST(DepthFile, MayHoldPositionsBesideColour) {
    const TemporaryFolder folder;
    QuickPart part{"", "", kFrame, {}};
    part.channels = {{"R"},
                     {"G"},
                     {"B"},
                     {"P.X", Imf::FLOAT, [](int x, int) { return x; }},
                     {"P.Y", Imf::FLOAT, [](int, int y) { return y; }},
                     {"P.Z", Imf::FLOAT, [](int x, int) { return 3 + x; }}};
    part.with = [](Imf::Header& h) { Imf::addWorldToCamera(h, Imath::M44f()); };
    write_quick_exr(folder / "p.exr", kFrame, {part});
    const auto read = depth_in(folder / "p.exr");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->depth(2, 0), 5);
    EXPECT_THAT(read->detected, Contains(HasSubstr("world position")));
}

TEST(DepthFile, ThatIsNoPictureIsRefusedWithItsPath) {
    const TemporaryFolder folder;
    test::write_bytes(folder / "z.txt", "no picture");
    EXPECT_THAT(depth_in(folder / "z.txt").error().message, HasSubstr("z.txt"));
    EXPECT_THAT(depth_in(folder / "missing.exr").error().message, HasSubstr("missing.exr"));
}

}  // namespace
}  // namespace petzval
