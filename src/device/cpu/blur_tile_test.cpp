// A blur made tile by tile, against the same blur of the whole picture.
#include "device/cpu/blur_tile.h"

#include "base/parallel.h"
#include "device/cpu/blur.h"

#include <random>

#include <gtest/gtest.h>

namespace petzval::device {
namespace {

constexpr int kWidth = 2 * BlurTile::kWidth - 30, kHeight = 2 * BlurTile::kHeight - 11;

// Lights here and there, some over each other.
struct Sparks {
    struct Spark {
        int x, y;
        Rgba light;
        float covered;
    };
    std::vector<Spark> all;
    explicit Sparks(int count) {
        std::mt19937 random(5);
        const auto up_to = [&](int n) { return int(random() % unsigned(n)); };
        const auto any = [&] { return float(up_to(1000)) / 700; };
        for (int i = 0; i < count; ++i)
            all.push_back({up_to(kWidth), up_to(kHeight), {any(), any(), any(), any()}, any()});
    }
};

TEST(BlurTile, IsTheBlurOfTheWholePictureToTheLastBit) {
    for (const auto& [radius_px, count] : {std::pair(4.0, 3), {4.0, 4000}, {1.0, 60}, {2.0, 0}}) {
        const engine::Blur blur = engine::blur_of(radius_px, 1.5, kWidth, kHeight);
        ASSERT_TRUE(blur.is_narrow());
        const Sparks sparks(count);
        BlurLayer whole(blur);
        for (const auto& s : sparks.all) {
            whole.light(s.x, s.y) += s.light, whole.covered(s.x, s.y) += s.covered;
            whole.lit[std::size_t(s.y)].add({s.x, s.x + 1});
        }
        blur_layer(whole, blur, one_thread());
        BlurTile tile(blur);
        BlurScratch scratch;
        for (int y0 = 0; y0 < kHeight; y0 += BlurTile::kHeight)
            for (int x0 = 0; x0 < kWidth; x0 += BlurTile::kWidth) {
                const Rect pixels = Rect{x0, y0, x0 + BlurTile::kWidth, y0 + BlurTile::kHeight}.intersected(
                    {0, 0, kWidth, kHeight});
                tile.go_to(pixels);
                for (const auto& s : sparks.all)
                    if (tile.window().contains(s.x, s.y)) tile.add(s.x, s.y, s.light, s.covered);
                tile.blur(scratch);
                for (int y = pixels.y0; y < pixels.y1; ++y)
                    for (int x = pixels.x0; x < pixels.x1; ++x) {
                        const bool lit = tile.reached().contains(x, y);
                        const float* const at = lit ? tile.at(x, y) : nullptr;
                        const Rgba light = lit ? Rgba{at[0], at[1], at[2], at[3]} : Rgba{};
                        ASSERT_EQ(light, whole.light(x, y)) << x << ", " << y;
                        ASSERT_EQ(lit ? at[4] : 0.0f, whole.covered(x, y)) << x << ", " << y;
                    }
            }
    }
}

}  // namespace
}  // namespace petzval::device
