// Real files from others; they lie beside the checkout and are not part of it.
#include "petzval/depth.h"
#include "petzval/files.h"

#include "files/test_exr.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string shared(const std::string& name) {
    return (std::filesystem::path(PETZVAL_SOURCE_DIR) / ".." / "shared" / name).string();
}

#define SKIP_WITHOUT(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << (path)

Result<Frame> view_of(const std::string& path, const std::string& view) {
    ReadOptions options;
    options.view_name = view;
    return read_frame(path, options);
}

TEST(SharedExr, BothEyesOfOneShotAreTheSameInOnePartAndInTenParts) {
    const std::string single = shared("exr/singlepart.0001.exr"), multi = shared("exr/multipart.0001.exr");
    SKIP_WITHOUT(single);
    for (const std::string view : {"left", "right"}) {
        const Result<Frame> a = view_of(single, view), b = view_of(multi, view);
        ASSERT_TRUE(a && b) << (a ? b : a).error().message;
        ASSERT_EQ(a->place.data_window, (Rect{654, 245, 1565, 1121}));
        ASSERT_EQ(a->place.display_window, (Rect{0, 0, 2048, 1556}));
        const Rect both = a->place.data_window.intersected(b->place.data_window);
        for (int y = both.y0; y < both.y1; ++y)
            for (int x = both.x0; x < both.x1; ++x) {
                const Rgba p = a->colour(x - a->place.data_window.x0, y - a->place.data_window.y0);
                const Rgba q = b->colour(x - b->place.data_window.x0, y - b->place.data_window.y0);
                ASSERT_EQ(p, q) << view << " " << x << "," << y;
                const float dp = a->depth(x - a->place.data_window.x0, y - a->place.data_window.y0);
                const float dq = b->depth(x - b->place.data_window.x0, y - b->place.data_window.y0);
                ASSERT_EQ(dp, dq) << view << " " << x << "," << y;
            }
        EXPECT_THAT(b->detected, Contains(HasSubstr("'depth_" + view + "'")));
    }
}

TEST(SharedExr, WithoutAViewTheFirstIsTakenAndSaid) {
    SKIP_WITHOUT(shared("exr/singlepart.0001.exr"));
    for (const char* name : {"exr/singlepart.0001.exr", "exr/multipart.0001.exr"}) {
        const Result<Frame> frame = read_frame(shared(name));
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_THAT(frame->detected, Contains(HasSubstr("view: right")));
        EXPECT_THAT(frame->detected, Contains(HasSubstr("'left'")));
        EXPECT_TRUE(frame->has_alpha);
    }
}

TEST(SharedExr, AWrongViewLayerOrDepthChannelListsThoseThereAre) {
    const std::string path = shared("exr/multipart.0001.exr");
    SKIP_WITHOUT(path);
    ReadOptions view, layer, depth;
    view.view_name = "middle", layer.layer = "beauty", depth.depth_channel = "Zed";
    for (const auto& [options, expected] : {std::pair(view, "'right', 'left'"),
                                            {layer, "'rgba_right', 'rgba_left'"},
                                            {depth, "'depth_left.Z'"}}) {
        const Result<Frame> frame = read_frame(path, options);
        ASSERT_FALSE(frame);
        EXPECT_EQ(frame.error().code, ErrorCode::InvalidArgument);
        EXPECT_THAT(frame.error().message, HasSubstr(expected));
    }
    depth.depth_channel = "depth_left.Z";
    EXPECT_TRUE(read_frame(path, depth));
}

TEST(SharedExr, TheTenPartFileIsWrittenBackWithNineUntouchedParts) {
    const std::string path = shared("exr/multipart.0001.exr");
    SKIP_WITHOUT(path);
    const test::TemporaryFolder folder;
    Result<Frame> frame = view_of(path, "left");
    ASSERT_TRUE(frame);
    frame->colour = Picture(frame->colour.width(), frame->colour.height(), {1, 2, 3, 1});
    const Status written = write_exr(folder / "out.exr", *frame);
    ASSERT_TRUE(written) << written.error().message;
    const Result<Frame> left = view_of(folder / "out.exr", "left"),
                        right = view_of(folder / "out.exr", "right");
    const Result<Frame> right_in = view_of(path, "right");
    ASSERT_TRUE(left && right && right_in);
    EXPECT_EQ(left->colour(100, 100), (Rgba{1, 2, 3, 1}));
    for (std::size_t i = 0; i < right->colour.size(); ++i)
        ASSERT_EQ(right->colour.pixels()[i], right_in->colour.pixels()[i]);
    ASSERT_EQ(left->parts.size(), 10u);
    for (std::size_t p = 0; p < 10; ++p) {
        EXPECT_EQ(left->parts[p].name, right_in->parts[p].name);
        EXPECT_EQ(left->parts[p].channels, right_in->parts[p].channels);
        EXPECT_EQ(left->parts[p].compression, right_in->parts[p].compression);
        EXPECT_EQ(left->parts[p].data_window, right_in->parts[p].data_window);
    }
    for (const char* channel :
         {"forward_left.forward.u", "whitebarmask_right.whitebarmask.mask", "disparityL.x"}) {
        ReadOptions options;
        options.depth_channel = channel;
        const Result<Frame> a = read_frame(path, options), b = read_frame(folder / "out.exr", options);
        ASSERT_TRUE(a && b);
        for (std::size_t i = 0; i < a->depth.size(); ++i)
            ASSERT_EQ(a->depth.pixels()[i], b->depth.pixels()[i]) << channel;
    }
}

TEST(SharedExr, DeepSamplesAreAllThereSortedAndComposeToTheFlatPicture) {
    for (const auto& [name, count, window] :
         {std::tuple("exr/deep_balls.exr", std::size_t(162877), Rect{131, 170, 895, 576}),
          {"exr/deep_trunks.exr", std::size_t(49152), Rect{0, 141, 1024, 576}}}) {
        SKIP_WITHOUT(shared(name));
        const Result<Frame> frame = read_frame(shared(name));
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->place.data_window, window);
        EXPECT_EQ(frame->deep.sample_count(), count);
        for (int y = 0; y < frame->deep.height(); ++y)
            for (int x = 0; x < frame->deep.width(); ++x) {
                const auto samples = frame->deep.at(x, y);
                double seen = 1, red = 0;
                for (std::size_t i = 0; i < samples.size(); ++i) {
                    ASSERT_LE(samples[i ? i - 1 : 0].depth, samples[i].depth);
                    ASSERT_EQ(samples[i].depth, samples[i].depth_back);
                    red += seen * double(samples[i].colour.r);
                    seen *= 1 - double(samples[i].colour.a);
                }
                ASSERT_NEAR(frame->colour(x, y).r, red, 1e-5);
                ASSERT_NEAR(frame->colour(x, y).a, 1 - seen, 1e-5);
                ASSERT_EQ(std::isinf(frame->depth(x, y)), samples.empty());
            }
    }
}

TEST(SharedExr, ARealDeepImageSurvivesBeingWrittenAgain) {
    const std::string path = shared("exr/deep_balls.exr");
    SKIP_WITHOUT(path);
    const test::TemporaryFolder folder;
    const Result<Frame> in = read_frame(path);
    ASSERT_TRUE(in);
    const Status written = write_deep_exr(folder / "a.exr", in->place, in->deep);
    ASSERT_TRUE(written) << written.error().message;
    const Result<Frame> out = read_frame(folder / "a.exr");
    ASSERT_TRUE(out) << out.error().message;
    ASSERT_EQ(out->deep.sample_count(), in->deep.sample_count());
    EXPECT_THAT(out->parts[0].channels,
                testing::ElementsAre("A half", "B half", "G half", "R half", "Z float"));
    for (std::size_t i = 0; i < in->deep.sample_count(); ++i) {
        ASSERT_EQ(in->deep.samples()[i].colour, out->deep.samples()[i].colour);
        ASSERT_EQ(in->deep.samples()[i].depth, out->deep.samples()[i].depth);
    }
}

TEST(SharedExr, TheScenesWithTruthHaveDepthInMetres) {
    for (const char* name : {"scenes/fence/pinhole.exr", "scenes/table/pinhole.exr"}) {
        SKIP_WITHOUT(shared(name));
        Result<Frame> frame = read_frame(shared(name));
        ASSERT_TRUE(frame) << frame.error().message;
        EXPECT_EQ(frame->colour.width(), 960);
        const auto report = depth_to_planar_metres(frame->depth, frame->place, {});
        ASSERT_TRUE(report);
        EXPECT_GT(report->nearest_m, 0.1f);
        EXPECT_LT(report->farthest_finite_m, 1000.f);
    }
}

}  // namespace
}  // namespace petzval
