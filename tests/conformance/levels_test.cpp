// --view levels, the light of each level of scatter; and the errors of engines with too little memory.
#include "shots.h"

namespace petzval::conformance {
namespace {

DefocusReport levels_of(const Shot& shot, Quality quality = Quality::Standard) {
    DefocusJob job = shot.job("scatter");
    job.scatter.view = ScatterView::Levels;
    job.quality = quality;
    auto report = defocus(job);
    EXPECT_TRUE(report);
    return std::move(*report);
}

// Light in a panel, in pixels of the picture; levels come first, level n in cells 2^n pixels wide.
double light_in(const DefocusReport& report, std::size_t panel) {
    const Rect& area = report.panels[panel].area;
    const double cell = report.panels[panel].name.starts_with("LEVEL") ? std::ldexp(1.0, int(panel)) : 1;
    double sum = 0;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) sum += double(report.image(x, y).g);
    return sum * cell * cell;
}

Shot a_point(float coc_px, float light) {
    Shot shot = flat(240, 160, {0, 0, 0, 1}, coc_px);
    shot.colour(120, 80) = {light, light, light, 1};
    return shot;
}

TEST(Levels, LieSideBySideWithinAnOversizedPicture) {
    const DefocusReport report = levels_of(a_point(40, 0.2f));
    ASSERT_GE(report.panels.size(), 4U);
    EXPECT_EQ(report.image.rect(), (Rect{0, 0, 480, 240}));
    EXPECT_EQ(report.panels[0].area, (Rect{0, 0, 240, 160}));
    EXPECT_EQ(report.panels[1].area, (Rect{0, 160, 120, 240}));
    for (std::size_t i = 0; i < report.panels.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_TRUE(report.panels[i].area.intersected(report.panels[j].area).empty()) << i << ", " << j;
}

TEST(Levels, TogetherWithTheHighlightsHoldTheLightOfThePicture) {
    for (const float coc : {0.0f, 5.0f, -9.0f, 20.0f, -38.0f})
        for (const float light : {0.2f, 500.0f}) {
            const DefocusReport report = levels_of(a_point(coc, light));
            double sum = 0;
            for (std::size_t i = 0; i + 1 < report.panels.size(); ++i) sum += light_in(report, i);
            EXPECT_NEAR(sum, double(light), 0.01 * double(light)) << coc;
        }
}

TEST(Levels, WiderRadiiAreDrawnByCoarserOnes) {
    Shot shot = flat(240, 160, {0.5f, 0.5f, 0.5f, 1}, 5);
    EXPECT_GT(light_in(levels_of(shot), 0), 15000);
    for (std::size_t i = 0; i < shot.coc_px.size(); ++i) shot.coc_px.pixels()[i] = 20;
    const DefocusReport wide = levels_of(shot);
    EXPECT_EQ(light_in(wide, 0), 0);
    EXPECT_GT(light_in(wide, 2), 15000);
    // Draft changes levels at smaller radii.
    EXPECT_EQ(light_in(levels_of(shot, Quality::Draft), 2), 0);
}

TEST(Levels, AreThoseOfScatter) {
    DefocusJob job = a_point(3, 1).job("gather");
    job.scatter.view = ScatterView::Levels;
    const auto refused = defocus(job);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("engine scatter"), std::string::npos);
}

TEST(Memory, GatherInStripsGivesTheSameBits) {
    const Shot shot = tall_with_screens();
    for (const bool varies : {false, true}) {
        DefocusJob whole = shot.job("gather");
        if (varies) whole.lens.cats_eye = 0.8;
        // Without its bright points every strip is copied, which is what they take more.
        for (const bool find : {false, true}) {
            whole.sprites.find = find;
            DefocusJob strips = whole;
            strips.max_memory_bytes = std::size_t(find ? 37 : 36) << 20;
            EXPECT_EQ(largest_difference(rendered(whole), rendered(strips)), 0);
        }
    }
}

}  // namespace
}  // namespace petzval::conformance
