// Laws of light for every engine on every device: its place, its amount, and pixels that stay unchanged.
#include "drawers.h"

namespace petzval::conformance {
namespace {

class Law : public EveryDrawer {};

TEST_P(Law, WhatIsInFocusIsAsItWas) {
    Shot shot = traces() ? flat(40, 23, {}, 0) : flat(170, 150, {}, 0);
    paint_noise(shot.colour, 1);
    EXPECT_LE(largest_difference(picture(shot), shot.colour), allows().in_focus);
}

TEST_P(Law, AConstantPictureStaysConstantUpToTheBorder) {
    const std::vector<float> few{-9.0f, 0.4f, 6.5f};
    const std::vector<float> many{-70, -40, -9, 0.4f, 0.7f, 2.5f, 6.5f, 13, 33};
    for (const float coc : traces() ? few : many)
        for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
            if (traces() && quality != Quality::Standard) continue;
            const Shot shot = flat(traces() ? 31 : 91, traces() ? 20 : 61, {0.2f, 0.5f, 0.7f, 1}, coc);
            DefocusJob constant = job(shot);
            constant.quality = quality;
            EXPECT_LE(largest_difference(drawn(constant), shot.colour), allows().constant)
                << coc << " quality " << int(quality);
        }
}

TEST_P(Law, AConstantPictureStaysConstantHoweverWideTheDiscs) {
    const std::vector<float> few{-40.0f}, many{-300, 1000, -3800, 12000};
    for (const float coc : traces() ? few : many) {
        const Shot shot = flat(48, 32, {0.2f, 0.2f, 0.2f, 1}, coc);
        EXPECT_LE(largest_difference(picture(shot), shot.colour), allows().constant) << coc;
    }
}

// A lit window in a dark wall over a grey floor, cut by the border. The lens sees as much of the window in
// the border's pixels as farther inside.
TEST_P(Law, ABrightSurfaceThatTheBorderCutsContinuesBeyondIt) {
    for (const float coc : {-3.0f, 1.5f, 3.0f}) {
        Shot shot = flat(64, 40, {0.3f, 0.3f, 0.3f, 1}, coc);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 64; ++x) {
                const bool is_window = y < 10 && x >= 26 && x < 38;
                shot.colour(x, y) = is_window ? Rgba{1, 0.8f, 0.6f, 1} : Rgba{0.01f, 0.01f, 0.01f, 1};
            }
        const Picture made = picture(shot);
        for (int y = 0; y < 5; ++y) EXPECT_NEAR(made(32, y).r, 1, 0.03) << coc << " row " << y;
    }
}

// Mean of pixels that lie differently in the cells of coarser grids, bright and faint, among larger radii or
// not.
Spot mean_spot(const Drawer& drawer, float coc, Quality quality, int pixels) {
    Spot mean;
    for (int i = 0; i < pixels; ++i) {
        const int at = (pixels > 1 ? 2 : 1) * int(std::abs(coc)) + 10 * pixels + i, size = 2 * at;
        Shot shot = flat(size, size, {0, 0, 0, 1}, coc);
        const float light = i % 2 ? 0.6f : 100;
        shot.colour(at, at) = {light, light, light, 1};
        if (i > 1) shot.coc_px(0, 0) = 1.4f * coc;
        DefocusJob job = drawer.job(shot);
        job.quality = quality;
        const Spot one = spot(drawer.drawn(job), at);
        mean.sum += one.sum / double(light) / pixels, mean.radius_px += one.radius_px / pixels;
    }
    return mean;
}

TEST_P(Law, APixelKeepsItsLightOverADiscOfItsRadius) {
    const std::vector<float> few{-6.5f, 12};
    const std::vector<float> many{-60, -12.5f, -3.3f, 0.3f, 0.9f, 2.7f, 7, 23, 40};
    for (const float coc : traces() ? few : many)
        for (const Quality quality : {Quality::Draft, Quality::Standard, Quality::Final}) {
            if (traces() && quality != Quality::Standard) continue;
            const Spot mean = mean_spot(drawer(), coc, quality, traces() ? 1 : 4);
            EXPECT_NEAR(mean.sum, 1, allows().light) << coc << " quality " << int(quality);
            if (std::abs(coc) > 2)
                EXPECT_NEAR(mean.radius_px, std::abs(coc), allows().radius * std::abs(double(coc)) + 0.05)
                    << coc << " quality " << int(quality);
        }
}

// Centroid of all green light, relative to (at, at).
struct Centre {
    double x = 0, y = 0;
};
Centre centre(const Picture& image, int at) {
    Centre sum;
    double light = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const double g = double(image(x, y).g);
            light += g, sum.x += g * (x - at), sum.y += g * (y - at);
        }
    return {sum.x / light, sum.y / light};
}

// Pixels that lie differently in the cells of coarser grids; among larger radii, which levels may go by.
TEST_P(Law, ADiscLiesWhereItsLightIs) {
    const std::vector<float> few{-6.5f}, many{-33.6f, -11, -2.5f, 4.3f, 10.5f, 21, 70};
    for (const float coc : traces() ? few : many)
        for (int i = 0; i < (traces() ? 1 : 4); ++i) {
            const int at = 3 * int(std::abs(coc)) + 20 + i, size = 2 * at;
            Shot shot = flat(size, size, {0, 0, 0, 1}, coc);
            shot.colour(at, at) = {100, 100, 100, 1};
            if (i > 0) shot.coc_px(0, 0) = (1 + 0.3f * float(i)) * coc;
            const Centre off = centre(picture(shot), at);
            EXPECT_NEAR(off.x, 0, allows().place) << coc << " at " << at;
            EXPECT_NEAR(off.y, 0, allows().place) << coc << " at " << at;
        }
}

template <typename T>
Image<T> mirrored(const Image<T>& image, bool upright) {
    Image<T> out(image.width(), image.height());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x)
            out(x, y) = upright ? image(x, image.height() - 1 - y) : image(image.width() - 1 - x, y);
    return out;
}

TEST_P(Law, AMirroredPictureGivesTheMirroredResult) {
    Shot shot = traces() ? flat(48, 32, {}, 5) : flat(128, 96, {}, 9);
    paint_rectangles(shot.colour, 6);
    for (int y = 0; y < shot.coc_px.height(); ++y)
        for (int x = 0; x < shot.coc_px.width(); ++x) shot.coc_px(x, y) = 0.15f * float(x - 20);
    const Picture image = picture(shot);
    for (const bool upright : {false, true}) {
        const Shot mirror{mirrored(shot.colour, upright), mirrored(shot.coc_px, upright), {}};
        EXPECT_LE(largest_difference(mirrored(picture(mirror), upright), image), allows().mirrored)
            << (upright ? "upside down" : "left for right");
    }
}

// Dark and in focus on the left, bright and behind on the right.
Shot focused_edge(float behind) {
    Shot shot = flat(128, 32, {0.1f, 0.1f, 0.1f, 1}, 0);
    for (int y = 0; y < 32; ++y)
        for (int x = 64; x < 128; ++x) shot.colour(x, y) = {0.9f, 0.9f, 0.9f, 1}, shot.coc_px(x, y) = behind;
    return shot;
}

TEST_P(Law, NothingBleedsFromBehindOverAnEdgeInFocus) {
    for (const float behind : {3.0f, 8.0f, 30.0f}) {
        const Shot shot = focused_edge(behind);
        DefocusJob edge = job(shot);
        edge.pupil_points = 256;
        const Picture image = drawn(edge);
        for (int x = 0; x < 64; ++x)
            EXPECT_NEAR(image(x, 16).g, 0.1, allows().bled) << x << " behind " << behind;
    }
}

// A dark half plane at -10 before a grey wall in focus.
Shot near_edge() {
    Shot shot = flat(64, 32, {0.8f, 0.8f, 0.8f, 1}, 0);
    for (int y = 0; y < 32; ++y)
        for (int x = 32; x < 64; ++x) shot.colour(x, y) = {0, 0, 0, 1}, shot.coc_px(x, y) = -10;
    return shot;
}

void expect_as_much_as_the_lens_sees(const Picture& image, double tolerance) {
    // Share of a disc of radius 10 on one side of a line at distance d: 1/2 + (asin t + t sqrt(1 - t^2)) /
    // pi, t = d / 10.
    for (int x = 18; x < 46; ++x) {
        const double t = std::clamp((32 - (x + 0.5)) / 10, -1.0, 1.0);
        const double clear = 0.5 + (std::asin(t) + t * std::sqrt(1 - t * t)) / M_PI;
        EXPECT_NEAR(image(x, 16).g, 0.8 * clear, tolerance) << x;
    }
}

TEST_P(Law, AtAnEdgeInFrontTheLensSeesAsMuchOfEachAsLiesBeforeIt) {
    Shot shot = near_edge();
    put_behind(
        shot,
        [](int, int) {
            return Rgba{0.8f, 0.8f, 0.8f, 1};
        },
        [](int, int) { return 0.0f; });
    expect_as_much_as_the_lens_sees(picture(shot), allows().near_edge);
}

// The law holds for any rings, levels or layers that the two share.
TEST_P(Law, AnOpaqueSheetHidesWhatIsStatedBehindIt) {
    const float pairs[][2] = {{-20, -17.5f}, {-7, -6}, {-6.5f, -2}, {2, 2.3f}, {5.5f, 7}, {16, 20}};
    for (const auto& [sheet, hidden] : pairs) {
        if (traces() && std::abs(sheet) > 7) continue;
        Shot shot = flat(48, 40, {0.2f, 0.2f, 0.2f, 1}, sheet);
        // Radii beside these two decide where rings lie.
        shot.coc_px(0, 0) = 1.3f * sheet;
        put_behind(
            shot,
            [](int, int) {
                return Rgba{1, 1, 1, 1};
            },
            [behind_px = hidden](int, int) { return behind_px; });
        DefocusJob behind = job(shot);
        behind.pupil_points = 64;
        const Picture image = drawn(behind);
        for (const int x : {20, 24, 30})
            EXPECT_NEAR(image(x, 20).g, 0.2, 1e-3) << sheet << " before " << hidden;
    }
}

// A pixel's layers are means of their surfaces over all of it; what shows of them it shows itself.
TEST_P(Law, HiddenLayersChangeNothingInFocus) {
    Shot shot = flat(60, 40, {}, 0);
    paint_noise(shot.colour, 7);
    std::mt19937 random(8);
    std::uniform_real_distribution<float> any(0, 1);
    shot.behind = DeepPicture::made_of(60, 40, [&](int, int, std::vector<DeepSample>& samples) {
        const float share = any(random), r = 0.5f * any(random);
        samples.push_back({{share * r, share * 0.4f, share * 0.2f, share}, -0.01f, -0.01f});
        samples.push_back({{0.1f, 0.6f * r, 0.5f, 1}, 0.0f, 0.0f});
        samples.push_back({{3, 2, 1, 1}, 0.02f, 0.02f});
    });
    // The reference meets each share with a whole number of its 1024 rays.
    EXPECT_LE(largest_difference(picture(shot), shot.colour), traces() ? 0.03 : allows().in_focus + 1e-5);
}

TEST_P(Law, EmptinessStaysEmptyAndCoverageIsBlurredAsColourIs) {
    for (const float coc : {-8.0f, 6.0f, 20.0f}) {
        if (traces() && coc == 20) continue;
        Shot shot = flat(120, 120, {}, coc);
        for (int y = 30; y < 90; ++y)
            for (int x = 30; x < 90; ++x) shot.colour(x, y) = {0.6f, 0.3f, 0.9f, 1};
        DefocusJob element = job(shot);
        element.pupil_points = 256;
        const Picture image = drawn(element);
        double coverage = 0, apart = 0;
        for (std::size_t i = 0; i < image.size(); ++i) {
            const Rgba c = image.pixels()[i];
            coverage += double(c.a);
            apart = std::max(apart, std::abs(double(c.r) - 0.6 * double(c.a)));
        }
        EXPECT_LE(apart, allows().emptiness) << coc;
        EXPECT_NEAR(coverage, 3600, 36) << coc;
        EXPECT_NEAR(image(60, 60).a, 1, 1e-3 + allows().tails) << coc;
        EXPECT_LE(image(2, 2).a, allows().tails) << coc;
        // Half a pixel inside a straight edge the disc sees a strip of half a pixel more than half of itself.
        EXPECT_NEAR(image(30, 60).a, 0.5 + 1 / (M_PI * std::abs(double(coc))), allows().near_edge) << coc;
    }
}

// A matte may leave the depth of a removed object, in front of the objects that remain.
TEST_P(Law, TheDepthOfEmptyPixelsChangesNothing) {
    for (const float coc : {-5.0f, 6.0f}) {
        Shot shot = flat(64, 64, {}, coc);
        for (int y = 20; y < 44; ++y)
            for (int x = 20; x < 44; ++x) shot.colour(x, y) = {0.6f, 0.3f, 0.9f, 1};
        const Picture wanted = picture(shot);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                if (shot.colour(x, y).a == 0) shot.coc_px(x, y) = -15;
        EXPECT_EQ(largest_difference(picture(shot), wanted), 0) << coc;
    }
}

// Laws of the estimated hidden background.
class Guess : public EveryDrawer {};

TEST_P(Guess, GoesOnBehindAnEdgeInFocus) {
    for (const float behind : {3.0f, 8.0f, 30.0f}) {
        const Picture image = picture(focused_edge(behind));
        for (int x = 64; x < 128; ++x) EXPECT_NEAR(image(x, 16).g, 0.9, 2e-3) << x << " behind " << behind;
    }
}

TEST_P(Guess, GoesOnWithAWallBehindAnEdgeInFront) {
    expect_as_much_as_the_lens_sees(picture(near_edge()), allows().near_edge);
}

TEST_P(Guess, LeavesConstantCoverageAsItIsAcrossStepsOfDepth) {
    Shot shot = flat(150, 60, {0.375f, 0.375f, 0.375f, 0.75f}, 0);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 150; ++x) shot.coc_px(x, y) = x < 50 ? -15.0f : x < 100 ? 0.0f : 9.0f;
    EXPECT_LE(largest_difference(picture(shot), shot.colour), allows().steps);
}

PETZVAL_EVERY_DRAWER(Law);
INSTANTIATE_TEST_SUITE_P(Guessing, Guess, testing::ValuesIn(guessing_drawers()), name_of_drawer);

}  // namespace
}  // namespace petzval::conformance
