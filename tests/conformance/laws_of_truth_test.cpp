// Every engine on every device against the reference on the same samples.
#include "drawers.h"

namespace petzval::conformance {
namespace {

constexpr Quality kQualities[] = {Quality::Draft, Quality::Standard, Quality::Final};

// `least` is what an engine's row asks of standard quality; a finer one is never worse than one before it.
void expect_close_to_the_reference(const Shot& shot, int border, double Tolerances::*least) {
    DefocusJob traced = shot.job("reference");
    traced.pupil_points = 2048;
    const Picture truth = rendered(traced);
    for (const Drawer& drawer : guessing_drawers()) {
        double best = 0;
        for (const Quality quality : kQualities) {
            DefocusJob job = drawer.job(shot);
            job.quality = quality;
            const double psnr_db = psnr_inside(truth, drawer.drawn(job), border);
            EXPECT_GE(psnr_db, best - 0.2) << testing::PrintToString(drawer) << " quality " << int(quality);
            best = std::max(best, psnr_db);
            if (quality == Quality::Standard)
                EXPECT_GE(psnr_db, drawer.allows().*least) << testing::PrintToString(drawer);
        }
    }
}

TEST(AgainstTheReference, BrightPointsInTheOpen) {
    for (const float coc : {14.0f, -24.0f}) {
        Shot shot = flat(160, 100, {0.05f, 0.05f, 0.06f, 1}, coc);
        std::mt19937 random(5);
        for (int i = 0; i < 20; ++i) {
            const float light = float(random() % 900);
            const int y = 8 + int(random() % 84), x = 8 + int(random() % 144);
            shot.colour(x, y) = {light, 0.8f * light, 0.5f * light, 1};
        }
        expect_close_to_the_reference(shot, 0, &Tolerances::points_db);
    }
}

TEST(AgainstTheReference, ASurfaceThatLeansThroughFocus) {
    Shot shot = flat(200, 120, {}, 0);
    paint_rectangles(shot.colour, 3);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 200; ++x) shot.coc_px(x, y) = 0.15f * float(x - 100) + 0.03f * float(y - 60);
    expect_close_to_the_reference(shot, 18, &Tolerances::slant_db);
}

TEST(AgainstTheReference, HardEdgesAtRadiiThatGrow) {
    // Radii from 6 to 20 px cross levels of scatter.
    Shot shot = flat(220, 120, {}, 0);
    paint_rectangles(shot.colour, 4);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 220; ++x) shot.coc_px(x, y) = 6 + 14 * float(x) / 220;
    expect_close_to_the_reference(shot, 24, &Tolerances::radii_db);
}

TEST(AgainstTheReference, ACornerOfThreeSurfacesWhereWhatIsHiddenIsKnown) {
    // In front a dark wedge at -14, then a grey one at -5, behind both a texture at 9.
    Shot shot = flat(180, 140, {}, 9);
    paint_rectangles(shot.colour, 6);
    const Picture texture = shot.colour.clone();
    shot.behind = DeepPicture::made_of(180, 140, [&](int x, int y, std::vector<DeepSample>& samples) {
        const bool front = x + y<130, middle = x> 60 && y < 80;
        if (front) shot.colour(x, y) = {0.1f, 0.12f, 0.1f, 1}, shot.coc_px(x, y) = -14;
        if (middle && front) samples.push_back({{0.6f, 0.5f, 0.4f, 1}, -5, -5});
        if (middle && !front) shot.colour(x, y) = {0.6f, 0.5f, 0.4f, 1}, shot.coc_px(x, y) = -5;
        if (front || middle) samples.push_back({texture(x, y), 9, 9});
    });
    expect_close_to_the_reference(shot, 24, &Tolerances::corner_db);
}

}  // namespace
}  // namespace petzval::conformance
