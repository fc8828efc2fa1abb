// Data kept between frames never shows: sessions against frames made alone, for every engine.
#include "drawers.h"

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {
namespace {

DefocusJob with_lens(DefocusJob job, const char* lens) {
    job.lens.name = lens;
    job.camera = {50, 36, 2, 3};
    job.pupil_points = 16;
    return job;
}

Picture through(Session& session, const DefocusJob& job) {
    auto report = session.defocus(job);
    EXPECT_TRUE(report) << report.error().message;
    return report ? std::move(report->image) : Picture();
}

// Two frames of noise and a lamp, at different radii.
struct TwoFrames {
    Shot first = flat(90, 70, {}, 6), second = flat(90, 70, {}, -11);
    TwoFrames() {
        paint_noise(first.colour, 5);
        paint_noise(second.colour, 6);
        second.colour(40, 30) = {900, 60, 20, 1};
    }
};

class EverySession : public EveryDrawer {};

TEST_P(EverySession, GivesTheBitsOfFramesMadeAlone) {
    const TwoFrames frames;
    Session session(drawer().session());
    for (const char* lens : {"doublet", "uncorrected", "ideal"})
        for (const Shot* shot : {&frames.first, &frames.second, &frames.first}) {
            const DefocusJob job = with_lens(drawer().job(*shot), lens);
            EXPECT_EQ(largest_difference(through(session, job), drawn(job)), 0) << lens;
        }
    // Another quality, and a lens stopped down, are other kernels.
    DefocusJob job = with_lens(drawer().job(frames.second), "doublet");
    job.quality = Quality::Draft;
    EXPECT_EQ(largest_difference(through(session, job), drawn(job)), 0);
    job.camera.f_number = 4;
    EXPECT_EQ(largest_difference(through(session, job), drawn(job)), 0);
}

TEST_P(EverySession, MakesTwoFramesAtOnce) {
    const TwoFrames frames;
    Session session(drawer().session());
    const DefocusJob first = with_lens(drawer().job(frames.first), "doublet"),
                     second = with_lens(drawer().job(frames.second), "doublet");
    Picture made_first, made_second;
    {
        std::thread beside([&] { made_first = through(session, first); });
        made_second = through(session, second);
        beside.join();
    }
    EXPECT_EQ(largest_difference(made_first, drawn(first)), 0);
    EXPECT_EQ(largest_difference(made_second, drawn(second)), 0);
}

TEST(Session, KeepsNoMoreThanItMayAndLosesNoBitByIt) {
    const TwoFrames frames;
    const DefocusJob job = with_lens(frames.second.job("scatter"), "doublet");
    Session session;
    const Picture first = through(session, job);
    EXPECT_GT(session.usage().kept_bytes, 0u);
    EXPECT_EQ(session.usage().lenses, 1);
    session.trim(1000);
    EXPECT_LE(session.usage().kept_bytes, 1000u);
    EXPECT_EQ(largest_difference(through(session, job), first), 0);
    session.trim(0);
    EXPECT_EQ(session.usage().lenses, 0);
    EXPECT_EQ(largest_difference(through(session, job), first), 0);
}

// The reference keeps no kernel itself: what is counted here is what the mounted lens remembers.
TEST(Session, CountsTheKernelsThatALensRemembers) {
    const TwoFrames frames;
    DefocusJob job = with_lens(frames.second.job("reference"), "double-gauss");
    job.camera.f_number = 2.8;
    Session session;
    const Picture first = through(session, job);
    EXPECT_GT(session.usage().kept_bytes, 1000u);
    session.trim(1000);
    EXPECT_LE(session.usage().kept_bytes, 1000u);
    EXPECT_EQ(largest_difference(through(session, job), first), 0);
}

TEST(Session, CountsWhatItKeepsAgainstItsMemory) {
    const TwoFrames frames;
    constexpr std::size_t kLimit = std::size_t(200) << 20;
    Session session({.threads = 0, .max_memory_bytes = kLimit});
    for (const char* lens : {"doublet", "uncorrected", "triplet", "asphere"})
        through(session, with_lens(frames.second.job("scatter"), lens));
    EXPECT_LE(session.usage().kept_bytes, kLimit / 8);
    EXPECT_EQ(session.usage().lenses, 4);
}

// Asked to stop at its n-th question: wherever that is, the frame ends as cancelled, and the next one is
// whole.
TEST_P(EverySession, EndsWhereverItIsAskedTo) {
    const TwoFrames frames;
    const DefocusJob job = with_lens(drawer().job(frames.second), "doublet");
    Session session(drawer().session());
    const Picture whole = through(session, job);
    for (const int questions : {0, 1, 3, 10, 30, 100, 300}) {
        std::atomic<int> asked{0};
        const auto stop = [&] { return asked++ >= questions; };
        const auto report = session.defocus(job, {.progress = {}, .cancelled = stop});
        if (report) {
            EXPECT_LE(asked, questions);
            continue;
        }
        EXPECT_EQ(report.error().code, ErrorCode::Cancelled);
    }
    EXPECT_EQ(largest_difference(through(session, job), whole), 0);
}

PETZVAL_EVERY_DRAWER(EverySession);

void expect_kernels_are_kept(const DefocusJob& job) {
    Session session;
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(session.defocus(job));  // surfaces are kept from the second on
    const std::size_t kept = session.usage().kept_bytes;
    EXPECT_GT(kept, 0u);
    ASSERT_TRUE(session.defocus(job));
    EXPECT_EQ(session.usage().kept_bytes, kept) << "kernels were made again, or under another name";
}

TEST(Session, AGatherFindsTheKernelsOfTheFrameBefore) {
    const Shot shot = noise_at_several_depths();
    DefocusJob job = shot.job("gather");
    job.lens.cats_eye = 0.5;
    expect_kernels_are_kept(job);
}

TEST(Session, SpritesFindTheKernelsOfTheFrameBefore) {
    const Shot shot = noise_at_several_depths();
    const std::vector<LightPoint> points{{.x = 10, .y = 12, .r = 1, .g = 1, .b = 1, .coc_px = 8}};
    DefocusJob job = shot.job("sprites");
    job.points = &points, job.sprites.background = SpriteBackground::Gaussian;
    job.lens.cats_eye = 0.5;
    expect_kernels_are_kept(job);
}

}  // namespace
}  // namespace petzval::conformance
