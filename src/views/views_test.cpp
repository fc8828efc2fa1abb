#include "petzval/views.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

bool is_bluer(const Rgba& p) { return p.b > 2 * p.r; }
bool is_more_orange(const Rgba& p) { return p.r > 2 * p.b; }

TEST(Views, OverlayIsBlueInFrontWhiteInFocusOrangeBehindAndBlackWhereNothingIs) {
    const Picture grey = [] {
        Picture p(4, 1);
        for (int x = 0; x < 4; ++x) p(x, 0) = {0.5f, 0.5f, 0.5f, 1};
        return p;
    }();
    Plane coc(4, 1);
    coc(0, 0) = -8, coc(1, 0) = 0.5f, coc(2, 0) = 8, coc(3, 0) = kNone;
    const Picture view = focus_overlay(grey.view(), coc.view(), 1, "");
    EXPECT_TRUE(is_bluer(view(0, 0)));
    EXPECT_EQ(view(1, 0).r, view(1, 0).b);
    EXPECT_TRUE(is_more_orange(view(2, 0)));
    EXPECT_EQ(view(3, 0), (Rgba{0, 0, 0, 1}));
}

TEST(Views, TheMapOfRadiiIsBlackInFocusAndFullAtTheLargestRadius) {
    Plane coc(3, 1);
    coc(0, 0) = -20, coc(1, 0) = 0, coc(2, 0) = 10;
    const Picture map = coc_map(coc.view(), "");
    EXPECT_EQ(map(0, 0), kNearColour);
    EXPECT_EQ(map(1, 0), (Rgba{0, 0, 0, 1}));
    EXPECT_NEAR(map(2, 0).r, 0.5f * kFarColour.r, 1e-6f);
}

TEST(Views, ALegendIsDrawnWhereThereIsRoomForItAndNowhereElse) {
    const auto differ = [](int width, int height) {
        Plane coc(width, height);
        coc(0, 0) = 5;
        const Picture with = coc_map(coc.view(), "FOCUS 4 M"), other = coc_map(coc.view(), "FOCUS 5 M");
        int pixels = 0;
        for (std::size_t i = 0; i < with.size(); ++i) pixels += with.pixels()[i] != other.pixels()[i];
        return pixels;
    };
    EXPECT_GT(differ(400, 200), 4);
    EXPECT_EQ(differ(40, 20), 0);
}

TEST(Views, NumbersBesideEachOtherDifferInTone) {
    EXPECT_EQ(colour_of_number(0), (Rgba{1, 1, 1, 1}));
    EXPECT_EQ(colour_of_number(kNone), (Rgba{0, 0, 0, 1}));
    for (const int sign : {-1, 1})
        for (int n = 1; n < 8; ++n) {
            const Rgba one = colour_of_number(float(sign * n)),
                       next = colour_of_number(float(sign * (n + 1)));
            EXPECT_EQ(sign < 0, is_bluer(one)) << n;
            EXPECT_GT(std::abs(one.g - next.g), 0.3f * std::min(one.g, next.g)) << n;
        }
}

TEST(Views, PanelsBecomeChannelsOfOnePictureIfEachNamesItsLayer) {
    Picture atlas(4, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x) atlas(x, y) = {float(x), float(y), 3, 1};
    std::vector<Panel> panels{{"LIGHT", {0, 0, 2, 2}, {}, "front"},
                              {"LAYER", {2, 0, 4, 2}, {}, "front.n", true}};
    const auto planes = planes_of(atlas, panels);
    ASSERT_EQ(planes.size(), 5u);
    EXPECT_EQ(planes[0].channel, "front.R");
    EXPECT_EQ(planes[0].values(1, 1), 1);
    EXPECT_EQ(planes[4].channel, "front.n");
    EXPECT_EQ(planes[4].values(1, 0), 3);
    panels[0].layer.reset();
    EXPECT_TRUE(planes_of(atlas, panels).empty());
}

TEST(Views, LettersStayWithinTheirPictureAndTheirStatedSize) {
    constexpr Rgba kInk{1, 1, 1, 1};
    const std::string text = "F/2.8";
    Picture page(text_width_px(text, 2) + 20, text_height_px(2) + 20);
    draw_text(page.view(), 10, 10, text, 2, kInk);
    int inside = 0, outside = 0;
    for (int y = 0; y < page.height(); ++y)
        for (int x = 0; x < page.width(); ++x)
            if (page(x, y) == kInk)
                ++(Rect{10, 10, page.width() - 10, page.height() - 10}.contains(x, y) ? inside : outside);
    EXPECT_GT(inside, 40);
    EXPECT_EQ(outside, 0);
    draw_text(page.view(), page.width() - 3, -4, text, 3, kInk);  // does not write past the edge
}

}  // namespace
}  // namespace petzval
