// Influences that may change no bit of any engine on any device, and inputs that may crash none.
#include "bottom_up.h"
#include "drawers.h"
#include "host_pool.h"

#include <limits>

namespace petzval::conformance {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A lens whose kernels differ over the picture, and something hidden, so that all stages have work.
class Bits : public EveryDrawer {
protected:
    Bits() {
        put_behind(
            shot_,
            [](int x, int y) {
                return Rgba{0.1f * float(x % 7), 0.1f * float(y % 5), 0.3f, 1};
            },
            [](int, int) { return 9.0f; });
    }
    DefocusJob busy() const {
        DefocusJob busy = job(shot_);
        busy.pupil_points = 64;
        busy.lens.cats_eye = 0.5;
        busy.lens.aperture.blades = 6;
        busy.threads = 1;
        return busy;
    }
    Shot shot_ = noise_at_several_depths();
};

TEST_P(Bits, DoNotDependOnTheNumberOfThreads) {
    DefocusJob three = busy();
    three.workers = &three_threads();
    EXPECT_EQ(largest_difference(drawn(busy()), drawn(three)), 0);
}

std::size_t threads_of_this_process() {
    std::size_t n = 0;
    for ([[maybe_unused]] const auto& t : std::filesystem::directory_iterator("/proc/self/task")) ++n;
    return n;
}

// A host's own threads do all the work, and nobody else's.
TEST_P(Bits, AreThoseOfLentThreadsWhichDoItAll) {
    HostPool pool;
    DefocusJob lent = busy();
    lent.workers = &pool;
    drawn(lent);  // a device may start what it needs once
    const std::size_t before = threads_of_this_process();
    const Picture image = drawn(lent);
    EXPECT_EQ(threads_of_this_process(), before) << "started threads of its own";
    EXPECT_GT(pool.loops(), 3);
    EXPECT_LE(pool.most_at_once(), pool.width());
    EXPECT_EQ(largest_difference(image, drawn(busy())), 0);
    EXPECT_EQ(threads_of_this_process(), before) << "one thread is not one thread";
}

TEST_P(Bits, AreTheSameOfRowsHeldBottomUp) {
    shot_.colour(20, 20).g = kNan;  // and the repair of a broken pixel
    const BottomUp<Rgba> colour(shot_.colour);
    const BottomUp<float> coc_px(shot_.coc_px);
    DefocusJob bottom_up = busy();
    bottom_up.colour = colour.view(), bottom_up.coc_px = coc_px.view();
    EXPECT_EQ(largest_difference(drawn(busy()), drawn(bottom_up)), 0);
}

class Endurance : public EveryDrawer {};

TEST_P(Endurance, OfAwkwardSizesAndOfLightAndRadiiThatAreNoNumbers) {
    std::mt19937 random(9);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 17}, {17, 1}, {65, 3}, {40, 31}}) {
        Shot shot = flat(width, height, {}, 0);
        paint_noise(shot.colour, 7);
        for (std::size_t i = 0; i < shot.coc_px.size(); ++i)
            shot.coc_px.pixels()[i] = float(int(random() % 400)) - 200;  // every pixel at another depth
        shot.coc_px(width / 2, 0) = kNan;
        // The reference continues the picture as far as rays come from.
        if (!traces() && width * height < 100)
            shot.coc_px(0, height / 2) = kInfinity, shot.coc_px(0, 0) = -kInfinity;
        shot.colour(width - 1, 0) = {-1, 1e30f, 0, kNan};
        shot.colour(0, 0) = {-3, kNan, 1e30f, 1};
        shot.colour(0, height - 1).g = kInfinity;
        DefocusJob awkward = job(shot);
        awkward.pupil_points = 64;
        const Picture image = drawn(awkward);
        for (std::size_t i = 0; i < image.size(); ++i) {
            const Rgba c = image.pixels()[i];
            ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b) && std::isfinite(c.a))
                << width << "x" << height << " at " << i;
        }
    }
}

TEST_P(Endurance, AnEmptyPictureIsRefused) {
    const Shot shot = flat(8, 8, {0.1f, 0.1f, 0.1f, 1}, 2);
    DefocusJob empty = job(shot);
    empty.colour = {};
    const auto refused = drawer().made(empty);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
}

TEST_P(Endurance, TooLittleMemoryIsRefusedByNameAndEnoughChangesNoBit) {
    const Shot shot = tall_with_screens();
    DefocusJob limited = job(shot);
    limited.pupil_points = 16;
    const Picture usual = drawn(limited);
    limited.max_memory_bytes = std::size_t(traces() ? 3 : 15) << 20;
    const auto refused = drawer().made(limited);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
    EXPECT_NE(refused.error().message.find("job.max_memory_bytes"), std::string::npos);
    const std::size_t named = named_bytes(refused.error());
    EXPECT_GT(named, limited.max_memory_bytes);
    for (const std::size_t enough : {named, std::size_t(2) << 30}) {
        limited.max_memory_bytes = enough;
        EXPECT_EQ(largest_difference(drawn(limited), usual), 0) << enough;
    }
}

PETZVAL_EVERY_DRAWER(Bits);
PETZVAL_EVERY_DRAWER(Endurance);

}  // namespace
}  // namespace petzval::conformance
