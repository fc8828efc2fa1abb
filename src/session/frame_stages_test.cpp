#include "petzval/frame_stages.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWide = 72, kHigh = 40;

// A card before a wall with a lamp on it.
struct Scene {
    Picture colour{kWide, kHigh, {0.2f, 0.3f, 0.4f, 1}};
    Plane depth{kWide, kHigh, 8.0f};
    Scene() {
        colour(50, 12) = {60, 40, 20, 1};
        for (int y = 14; y < 34; ++y)
            for (int x = 8; x < 30; ++x) colour(x, y) = {0.7f, 0.1f, 0.1f, 1}, depth(x, y) = 1.2f;
    }
    Rendered rendered() const {
        Rendered r;
        r.colour = colour, r.depth = PlanarDepth{depth};
        r.camera = {50, 36, 2.8, 2.5};
        r.place = Place::whole(colour.rect());
        return r;
    }
};

Look with_light() {
    Look look;
    look.vignetting = true, look.glare.veil = 0.1, look.glare.bloom = 0.2;
    return look;
}

bool same(const Picture& a, const Picture& b) {
    return a.rect() == b.rect() && std::equal(a.pixels(), a.pixels() + a.size(), b.pixels());
}

TEST(FrameStages, StagesOneByOneGiveTheBitsOfAllAtOnce) {
    const Scene scene;
    Session session;
    const auto whole = session.take(scene.rendered(), with_light());
    auto frame = FrameStages::begin(session, scene.rendered(), with_light());
    ASSERT_TRUE(whole && frame) << frame.error().message;
    EXPECT_TRUE(frame->blur());
    EXPECT_TRUE(frame->falloff());
    EXPECT_TRUE(frame->glare());
    const auto report = std::move(*frame).report();
    ASSERT_TRUE(report);
    EXPECT_TRUE(same(report->image, whole->image));
}

TEST(FrameStages, AStageThatIsLeftOutChangesNothing) {
    const Scene scene;
    Session session;
    Look blur_alone;
    const auto expected = session.take(scene.rendered(), blur_alone);
    auto frame = FrameStages::begin(session, scene.rendered(), with_light());
    ASSERT_TRUE(expected && frame);
    EXPECT_TRUE(frame->blur());
    const auto report = std::move(*frame).report();
    ASSERT_TRUE(report);
    EXPECT_TRUE(same(report->image, expected->image));
}

TEST(FrameStages, ContinuesFromAPictureThatIsBlurredAlready) {
    const Scene scene;
    Session session;
    const auto whole = session.take(scene.rendered(), with_light());
    auto blurred = session.take(scene.rendered(), Look{});
    auto frame = FrameStages::begin(session, scene.rendered(), with_light());
    ASSERT_TRUE(whole && blurred && frame);
    EXPECT_FALSE(frame->take_blurred(Picture(3, 3)));
    EXPECT_TRUE(frame->take_blurred(std::move(blurred->image)));
    const auto report = std::move(*frame).take();
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(same(report->image, whole->image));
}

TEST(FrameStages, RefusesStagesOutOfOrderAndTwice) {
    const Scene scene;
    Session session;
    auto frame = FrameStages::begin(session, scene.rendered(), with_light());
    ASSERT_TRUE(frame);
    EXPECT_FALSE(frame->glare()) << "before the blur";
    EXPECT_FALSE(frame->codes()) << "none were asked for";
    EXPECT_TRUE(frame->blur());
    EXPECT_FALSE(frame->blur());
    EXPECT_TRUE(frame->glare());
    EXPECT_FALSE(frame->falloff()) << "after glare";
}

TEST(FrameStages, CodesAreThoseOfTheWhole) {
    const Scene scene;
    Session session;
    const Control control{.codes = CodesWanted{}};
    const auto whole = session.take(scene.rendered(), with_light(), control);
    auto frame = FrameStages::begin(session, scene.rendered(), with_light(), control);
    ASSERT_TRUE(whole && frame);
    for (const Status& done : {frame->blur(), frame->falloff(), frame->glare(), frame->codes()})
        EXPECT_TRUE(done);
    const auto report = std::move(*frame).report();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->codes, whole->codes);
    EXPECT_FALSE(report->codes.empty());
    EXPECT_TRUE(report->image.empty());
}

TEST(FrameStages, WindowsLieWithinEachOther) {
    const Scene scene;
    Session session;
    const auto holds = [](const Rect& outer, const Rect& inner) { return inner.intersected(outer) == inner; };
    for (const bool lit : {false, true}) {
        auto frame = FrameStages::begin(session, scene.rendered(), lit ? with_light() : Look{},
                                        {.region = Rect{40, 4, 60, 20}});
        ASSERT_TRUE(frame);
        ASSERT_TRUE(frame->blur());
        const Windows& windows = frame->windows();
        EXPECT_EQ(windows.asked, (Rect{40, 4, 60, 20}));
        EXPECT_EQ(windows.made, lit ? scene.colour.rect() : windows.asked) << "glare takes the whole frame";
        EXPECT_TRUE(holds(windows.made, windows.asked));
        EXPECT_TRUE(holds(windows.seen, windows.made));
        const auto report = std::move(*frame).take();
        ASSERT_TRUE(report);
        EXPECT_EQ(report->image.rect(), (Rect{0, 0, 20, 16}));
    }
}

TEST(FrameStages, AJobsFieldsThatAreNotUsedAreNamed) {
    const Scene scene;
    Session session;
    DefocusJob job;
    job.colour = scene.colour, job.depth_m = scene.depth;
    job.camera = scene.rendered().camera, job.place = scene.rendered().place;
    const auto silent = session.take(job, Look{});
    ASSERT_TRUE(silent);
    const std::size_t usual = silent->warnings.size();
    job.quality = Quality::Draft;
    job.max_memory_bytes = 1 << 30;
    const auto named = session.take(job, Look{});
    ASSERT_TRUE(named);
    ASSERT_EQ(named->warnings.size(), usual + 2);
    EXPECT_NE(named->warnings[usual].find("job.quality"), std::string::npos);
    EXPECT_NE(named->warnings[usual + 1].find("job.max_memory_bytes"), std::string::npos);
    EXPECT_TRUE(same(named->image, silent->image));
}

}  // namespace
}  // namespace petzval
