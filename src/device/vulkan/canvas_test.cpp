#include "device/vulkan/canvas.h"

#include "device/vulkan/driver/test_context.h"

#include <array>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

constexpr int kWidth = 7, kHeight = 5, kSide = 4;

Rgba numbered(int n) { return {float(n), float(2 * n), 0.5f, 1}; }

// Four squares over the picture, of which only a part lies in it; then the same added to two of them; then
// rows.
void draw(Context& context, Target out) {
    const std::array<Rect, 4> places{
        {{0, 0, 4, 4}, {4, 0, kWidth, 4}, {0, 4, 4, kHeight}, {4, 4, kWidth, kHeight}}};
    std::vector<Rgba> squares;
    for (int i = 0; i < 4 * kSide * kSide; ++i) squares.push_back(numbered(i));
    const auto deliver = [&](std::span<const Rect> to, bool adds) {
        Recording recording(context);
        const Piece drawn = recording.uploaded(std::span<const Rgba>(squares));
        Delivery delivery(context, out);
        delivery.squares(recording, drawn, to, kSide, adds);
        recording.run();
        delivery.finish();
    };
    deliver(places, false);
    deliver(std::span(places).last(2), true);
    Recording recording(context);
    const Piece drawn = recording.uploaded(std::span<const Rgba>(squares));
    Delivery delivery(context, out);
    delivery.rows(recording, drawn, 1, 2, 3);
    recording.run();
    delivery.finish();
}

TEST(DeviceCanvas, HoldsWhatTheHostsMemoryWould) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    Picture home(kWidth, kHeight);
    draw(*context, home);
    EXPECT_EQ(home(6, 3), numbered(30));
    EXPECT_EQ(home(1, 2), numbered(8)) << "a row, from the second of its piece";
    EXPECT_EQ(home(5, 4), numbered(49) + numbered(17)) << "added";
    DeviceCanvas canvas(*context, Picture(kWidth, kHeight));
    ASSERT_NE(canvas.drawn_on(), nullptr);
    draw(*context, canvas);
    EXPECT_EQ(std::memcmp(canvas.take().pixels(), home.pixels(), home.bytes()), 0);
}

TEST(DeviceCanvas, StaysAtHomeOnceAskedForUntilItIsSent) {
    const auto context = any_context();
    if (!context) GTEST_SKIP() << "no Vulkan device";
    DeviceCanvas canvas(*context, Picture(kWidth, kHeight));
    canvas.view()(2, 1) = numbered(9);
    EXPECT_EQ(canvas.drawn_on(), nullptr);
    ASSERT_NE(canvas.sent(), nullptr);
    EXPECT_EQ(canvas.drawn_on(), canvas.sent()) << "now it is there";
    EXPECT_EQ(canvas.view()(2, 1), numbered(9));
    draw(*context, canvas);
    EXPECT_EQ(canvas.view()(6, 3), numbered(30)) << "drawn at home";
}

}  // namespace
}  // namespace petzval::device::vulkan
