// Clean plates that state all of the frame, a crop of it, or patches.
#include "engine/samples/behind/plate.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kWidth = 40, kHeight = 20;

// The picture behind a surface of radius -4 px, with a plate of radius 5 px in the pixels (x, y) that
// states(x, y) names.
template <typename States>
BackPicture picture_behind(const States& states) {
    const Picture colour(kWidth, kHeight, Rgba{1, 1, 1, 1});
    const Plane radii(kWidth, kHeight, -4.0f);
    const auto plate =
        DeepPicture::made_of(kWidth, kHeight, [&](int x, int y, std::vector<DeepSample>& samples) {
            if (states(x, y)) samples.push_back({{0.5f, 0.5f, 0.5f, 1}, 5, 5});
        });
    const StatedPicture stated{.colour = colour,
                               .depth = radii,
                               .behind = &plate,
                               .meaning = StatedRadii{[](float radius) { return radius; }}};
    return back_picture(stated, one_thread());
}

TEST(Plate, OfAllOfTheFrameCovers) {
    EXPECT_TRUE(picture_behind([](int, int) { return true; }).covers);
    EXPECT_TRUE(picture_behind([](int x, int) { return x % 16 > 0; }).covers);  // 37 of 40 columns
}

TEST(Plate, ThatIsACropCoversToo) {
    const BackPicture back = picture_behind([](int x, int y) { return Rect{10, 5, 25, 15}.contains(x, y); });
    EXPECT_TRUE(back.covers);
    EXPECT_EQ(back.coc_px(10, 5), 5);
    EXPECT_EQ(back.coc_px(9, 5), -4) << "the picture's own pixel";
    EXPECT_FALSE(back.is_stated(9, 5));
}

TEST(Plate, OfPatchesDoesNotCover) {
    EXPECT_FALSE(picture_behind([](int x, int y) { return std::abs(x - 2 * y) < 5; }).covers);
    EXPECT_FALSE(picture_behind([](int x, int y) { return x < 6 && y < 6; }).covers) << "one small patch";
}

}  // namespace
}  // namespace petzval::engine
