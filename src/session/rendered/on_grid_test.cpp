#include "session/rendered/on_grid.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(OnGrid, AWindowBeginsAWholeNumberOfCellsFromTheDisplayWindow) {
    const Rect display{10, 20, 1010, 620};
    EXPECT_EQ(on_grid(display, display, 64), display);
    EXPECT_EQ(on_grid(display, {11, 20, 900, 600}, 64), (Rect{10, 20, 900, 600}));
    EXPECT_EQ(on_grid(display, {74, 83, 900, 600}, 64), (Rect{74, 20, 900, 600}));
    EXPECT_EQ(on_grid(display, {-10, 19, 900, 600}, 64), (Rect{-54, -44, 900, 600}));
}

TEST(OnGrid, TheGridIsAsCoarseAsAnyLevelForTheRadius) {
    EXPECT_EQ(grid_for(0, false), 64);
    EXPECT_EQ(grid_for(100, false), 128);
    EXPECT_EQ(grid_for(100, true), 1024);
    EXPECT_EQ(grid_for(1e9f, false), 1024);
}

TEST(OnGrid, BeyondAnEdgeInsideTheFrameIsEmptinessBeyondOthersTheBorderWithoutItsLights) {
    Picture colour(20, 10, Rgba{0.5f, 0.5f, 0.5f, 1});
    colour(0, 4) = {900, 900, 900, 1};
    const Plane depth(20, 10, 3.0f);
    Rendered asked;
    asked.colour = colour, asked.depth = PlanarDepth{depth};
    asked.place.display_window = {0, 0, 64, 64}, asked.place.data_window = {-2, 30, 18, 40};
    const WiderFrame wider(asked, {-64, 0, 18, 40});
    const View<const Rgba> image = wider.rendered().colour;
    EXPECT_EQ(image.width(), 82);
    EXPECT_EQ(image(10, 10).a, 0);  // above: inside the frame
    EXPECT_EQ(image(10, 32).a, 1);  // to the left: outside it
    EXPECT_LT(image(10, 34).r, 1.1f);
    EXPECT_EQ(depth_or_radii(wider.rendered())(10, 10), 3);
}

}  // namespace
}  // namespace petzval
