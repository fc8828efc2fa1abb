// Nothing flickers: what scatter makes of a focus pull and of a camera move changes from frame to frame as
// the truth does. Small pictures with few frames; `./dev bench flicker` shows the same on more.
#include "flicker.h"

#include <gtest/gtest.h>

namespace petzval::flicker {
namespace {

constexpr int kFrames = 8;

// Frames in which the size of every blur jumps to and fro by five per cent, as an engine's would that snaps
// radii to steps.
Frames with_jumping_blurs(const Shot& shot) {
    Frames frames;
    for (std::size_t t = 0; t < shot.cameras.size(); ++t) {
        DefocusJob job = job_of(shot, t, "scatter");
        job.camera.f_number *= t % 2 ? 1.05 : 1;
        frames.push_back(std::move(defocus(job).value().image));
    }
    return frames;
}

// Limits: the measured values with a little room; a perfect engine would have no change, no jump and a shake
// of 1.
struct Limits {
    double least_change_db, most_pop, most_shake;
};

void expect_steady(const Steadiness& found, const Limits& limits) {
    EXPECT_GE(found.change_db, limits.least_change_db);
    EXPECT_LE(found.worst_pop, limits.most_pop)
        << "from frame " << found.frame << " on, 8 x 8 pixels at " << found.x << ", " << found.y;
    EXPECT_LE(found.shake, limits.most_shake);
    testing::Test::RecordProperty("change_db", std::to_string(found.change_db));
    testing::Test::RecordProperty("worst_pop", std::to_string(found.worst_pop));
    testing::Test::RecordProperty("shake", std::to_string(found.shake));
}

void expect_steady_pull(const Shot& shot, const Limits& limits) {
    const Steadiness found = measure(defocused(shot, "scatter"), shot.truth);
    expect_steady(found, limits);
    // A test that cannot fail says nothing: the same engine with blurs that jump is found much worse, however
    // good it is without.
    const Steadiness jumping = measure(with_jumping_blurs(shot), shot.truth);
    EXPECT_LT(jumping.change_db, found.change_db - 1);
    EXPECT_GT(jumping.shake, 1.3 * found.shake);
}

TEST(Flicker, AFocusPullThroughLampsIsSteady) {
    expect_steady_pull(focus_pull("night", {}, kFrames, 5, 4, 3, 128), {40.5, 0.011, 0.75});
}

TEST(Flicker, AFocusPullAlongATableIsSteady) {
    expect_steady_pull(focus_pull("table", {}, kFrames, 1.3, 1.1, 3, 128), {48.5, 0.004, 0.6});
}

TEST(Flicker, ACameraMoveBehindAFenceIsSteady) {
    // The background behind wires is estimated anew in every frame: three times the truth's shake, the
    // weakest shot of all. These wires are narrower than a pixel, so one depth per pixel sees them come and
    // go.
    Shot shot = camera_move("fence", {}, 20, 6, 256);
    const Steadiness alone = measure(defocused(shot, "scatter"), shot.truth);
    expect_steady(alone, {36.8, 0.01, 2.8});
    // The frames around see behind some pixels of a wire and not behind others; they must not make it worse.
    look_around(shot, 4);
    const Steadiness together = measure(defocused(shot, "scatter"), shot.truth);
    EXPECT_GT(together.change_db, alone.change_db - 0.1);
    EXPECT_LT(together.shake, 1.03 * alone.shake);
}

TEST(Flicker, ACameraMovePastAPostIsSteady) {
    // Lamps and lit signs slip behind the post, and with them goes what is guessed of them; single bulbs go
    // out at once behind wires.
    Shot shot = camera_move("post", {}, 8, 5, 128);
    const Steadiness alone = measure(defocused(shot, "scatter"), shot.truth);
    expect_steady(alone, {29.5, 0.105, 2.8});
    // The frames around see the background behind the post, which then needs no estimate.
    look_around(shot, 4);
    const Steadiness together = measure(defocused(shot, "scatter"), shot.truth);
    EXPECT_GT(together.change_db, alone.change_db + 0.5);
    EXPECT_LT(together.shake, 0.95 * alone.shake);
}

}  // namespace
}  // namespace petzval::flicker
