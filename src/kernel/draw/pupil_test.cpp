// Tests of everything that shapes and dims the pupil: barrel, doors, iris, texture, pictures of discs.
#include "kernel/draw/pupil.h"

#include "kernel/lenses/kernel_testing.h"
#include "kernel/lenses/make_lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

PointSpread spread(const LensChoice& choice, double radius = 30, FieldPosition field = {0, 0},
                   const Mount& mount = full_frame()) {
    return lens_of(choice, mount)->point_spread(radius, field);
}

LensChoice with(auto set, const std::string& name = "ideal") {
    LensChoice choice;
    choice.name = name;
    set(choice);
    return choice;
}

// A transmission that is dark except for a square in its upper right quarter.
std::shared_ptr<const Plane> upper_right() {
    auto plane = std::make_shared<Plane>(64, 64, 0.0f);
    for (int y = 12; y < 24; ++y)
        for (int x = 40; x < 52; ++x) (*plane)(x, y) = 1;
    return plane;
}

TEST(Barrel, ARimInFrontCutsTheSideOfTheFieldAndARimBehindTheOther) {
    const auto centre = [](double distance_mm) {
        LensChoice choice;
        choice.barrel = {{12.5, distance_mm}};  // as wide as the pupil of 50 mm f/2
        return moments(spread(choice, 30, {0.8, 0})).x;
    };
    EXPECT_LT(centre(15), -1);
    EXPECT_GT(centre(-15), 1);
    EXPECT_NEAR(centre(15), -centre(-15), 0.01);
    EXPECT_NEAR(centre(0), 0, 0.01);
}

// The hood of a rectilinear lens of 120 degrees: its rim's shadow on the pupil moves by distance *
// tan(angle).
TEST(Barrel, AHoodAt120DegreesCutsByItsShadow) {
    Mount wide = full_frame();
    wide.camera.focal_length_mm = 18 / std::tan(60 * std::numbers::pi / 180);   // 36 mm are seen under 120
    const double pupil_mm = wide.camera.focal_length_mm / 4, distance_mm = 10;  // of f/2
    const double field = 18 / (0.5 * std::hypot(36.0, 20.25));  // the middle of the frame's right edge
    // An edge through the pupil's middle leaves half of it, less the part that its bend cuts.
    LensChoice choice;
    choice.barrel = {{distance_mm * std::tan(60 * std::numbers::pi / 180), distance_mm}};
    const auto area_of = [&](FieldPosition at) { return 1 / brightest(spread(choice, 30, at, wide)); };
    EXPECT_NEAR(area_of({0, 0}), std::numbers::pi * 30 * 30, 20);
    const double left = 0.5 - pupil_mm / choice.barrel[0].radius_mm / (3 * std::numbers::pi);
    EXPECT_NEAR(area_of({field, 0}) / area_of({0, 0}), left, 0.005);
}

TEST(Barrel, TwoRimsMakeALemonOneRimAOneSidedCut) {
    LensChoice lemon;
    lemon.barrel = {{13, 15}, {13, -15}};
    EXPECT_NEAR(moments(spread(lemon, 30, {0.8, 0})).x, 0, 0.01);
    EXPECT_LT(moments(spread(lemon, 30, {0.8, 0})).xx, 0.8 * moments(spread({}, 30)).xx);
}

TEST(Barrel, CutsContinuouslyOverTheField) {
    LensChoice choice;
    choice.barrel = {{14, 20}};
    double before = moments(spread(choice, 30, {0, 0})).x;
    for (double x = 0.01; x <= 1; x += 0.01) {
        const double now = moments(spread(choice, 30, {x, 0})).x;
        EXPECT_LT(std::abs(now - before), 0.5) << x;
        before = now;
    }
}

TEST(Barrel, StoppingDownOpensIt) {
    LensChoice choice;
    choice.barrel = {{12.5, 15}};
    const PointSpread s = spread(choice, 30, {0.8, 0}, full_frame(8)), disc = spread({}, 30);
    EXPECT_LT(largest_difference(s, disc), 1e-6);
}

TEST(Barrel, EvenAHoodThatHidesEverythingLeavesAKernel) {
    LensChoice choice;
    choice.barrel = {{3, 200}};
    EXPECT_NEAR(sums(spread(choice, 30, {1, 0})).g, 1, 1e-6);
}

TEST(BarnDoors, CoverTheirSideAndTurnInFrontOfFocus) {
    const LensChoice choice = with([](LensChoice& c) { c.barn_doors = {.left = 0.5, .top = 1.2}; });
    const PointSpread far = spread(choice), near = spread(choice, -30);
    EXPECT_EQ(weight_at(far, -20, 10).g, 0);
    EXPECT_GT(weight_at(far, -12, 10).g, 0);
    EXPECT_EQ(weight_at(far, 10, 0).g, 0);  // the upper door reaches 1.2 radii down: to y = +6 px
    EXPECT_GT(weight_at(far, 10, 9).g, 0);
    EXPECT_EQ(weight_at(near, 20, -10).g, 0);
    EXPECT_GT(weight_at(near, 12, -10).g, 0);
}

TEST(Iris, IsRoundWhereItIsOpenAndAPolygonTwoStopsDown) {
    LensChoice choice;
    choice.aperture = {.blades = 6, .round_at_f_number = 2};
    const PointSpread disc = spread({}, 30);
    EXPECT_LT(largest_difference(spread(choice, 30, {}, full_frame(2)), disc), 0.01 * brightest(disc));
    LensChoice polygon;
    polygon.aperture.blades = 6;
    EXPECT_LT(largest_difference(spread(choice, 30, {}, full_frame(4)), spread(polygon)), 1e-6);
    const double half_way = brightest(spread(choice, 30, {}, full_frame(2.5)));
    EXPECT_GT(half_way, brightest(disc) * 1.01);
    EXPECT_LT(half_way, brightest(spread(polygon)) * 0.99);
}

TEST(ApertureImage, IsUprightBehindFocusAndTurnedInFront) {
    for (const std::string name : {"ideal", "doublet"}) {
        const LensChoice choice = with([](LensChoice& c) { c.texture.image = upper_right(); }, name);
        const Moments far = moments(spread(choice, 40)), near = moments(spread(choice, -40));
        EXPECT_GT(far.x, 10) << name;
        EXPECT_LT(far.y, -10) << name;  // up
        EXPECT_LT(near.x, -10) << name;
        EXPECT_GT(near.y, 10) << name;
        EXPECT_NEAR(sums(spread(choice, 40)).r, 1, 1e-6);
    }
}

TEST(ApertureImage, OfWhiteChangesNothing) {
    const auto white = std::make_shared<const Plane>(10, 10, 1.0f);
    const LensChoice choice = with([&](LensChoice& c) { c.texture.image = white; });
    EXPECT_LT(largest_difference(spread(choice), spread({})), 1e-3 * brightest(spread({})));
}

TEST(ApertureImage, WithoutLightIsRefused) {
    LensChoice choice;
    choice.texture.image = std::make_shared<const Plane>(8, 8, 0.0f);
    const auto lens = make_lens(choice, full_frame());
    ASSERT_FALSE(lens);
    EXPECT_NE(lens.error().message.find("lens.aperture_image"), std::string::npos);
}

TEST(Texture, DustScratchesAndRingsShowInLargeDiscsForEveryKindOfLens) {
    for (const std::string name : {"ideal", "triplet", "triplet-cooke"}) {
        const auto unevenness = [&](auto set, double radius) {
            const PointSpread plain = spread(with([](LensChoice&) {}, name), radius, {0.1, 0}, full_frame(4));
            const PointSpread marked = spread(with(set, name), radius, {0.1, 0}, full_frame(4));
            return largest_difference(plain, marked) / brightest(plain);
        };
        const auto dust = [](LensChoice& c) { c.texture.dust = 1; };
        EXPECT_GT(unevenness(dust, 60), 0.15) << name;
        EXPECT_GT(unevenness(dust, 60), 1.5 * unevenness(dust, 6)) << name;
        EXPECT_GT(unevenness([](LensChoice& c) { c.texture.scratches = 1; }, 60), 0.05) << name;
        EXPECT_GT(unevenness([](LensChoice& c) { c.texture.onion_rings = 1; }, 60), 0.1) << name;
    }
}

TEST(Texture, IsSharedByThoseWhoAskForTheSame) {
    PupilTexture texture{.image = nullptr, .dust = 0.5, .scratches = 0, .onion_rings = 0, .seed = 7};
    const auto first = shared_texture(texture), second = shared_texture(texture);
    EXPECT_EQ(first, second);
    texture.seed = 8;
    EXPECT_NE(shared_texture(texture), first);
    texture.seed = 7;
    EXPECT_EQ(shared_texture(texture)->mean({0.1, 0.2}, 0.1, 0.1), first->mean({0.1, 0.2}, 0.1, 0.1));
}

TEST(Texture, IsTheSameForTheSameSeed) {
    PupilTexture texture{.image = nullptr, .dust = 0.5, .scratches = 0.5, .onion_rings = 0.5, .seed = 7};
    const Plane a = drawn_texture(texture), b = drawn_texture(texture);
    texture.seed = 8;
    const Plane c = drawn_texture(texture);
    bool differs = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a.pixels()[i], b.pixels()[i]);
        ASSERT_GE(a.pixels()[i], 0);
        ASSERT_LE(a.pixels()[i], 1);
        differs = differs || a.pixels()[i] != c.pixels()[i];
    }
    EXPECT_TRUE(differs);
}

TEST(Texture, RaysCarryIt) {
    const auto lens = lens_of(with([](LensChoice& c) { c.texture.image = upper_right(); }));
    const PointSpread s = lens->point_spread(20, {});
    double x = 0, y = 0;
    for (const PupilRay& ray : lens->rays(1 << 14, {}, 1))
        x += double(ray.weight.g * ray.x), y += double(ray.weight.g * ray.y);
    EXPECT_NEAR(20 * x, moments(s).x, 0.3);
    EXPECT_NEAR(20 * y, moments(s).y, 0.3);
}

TEST(KernelImage, IsUsedAsItIsAndTurnsInFrontOfFocus) {
    auto red_left = std::make_shared<Picture>(32, 32, Rgba{0.1f, 0.1f, 0.1f, 1});
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 8; ++x) (*red_left)(x, y).r = 3;
    LensChoice choice;
    choice.kernel_images.far = red_left;
    const PointSpread far = spread(choice, 20), near = spread(choice, -20);
    EXPECT_GT(weight_at(far, -15, 0).r, 3 * weight_at(far, 15, 0).r);
    EXPECT_GT(weight_at(near, 15, 0).r, 3 * weight_at(near, -15, 0).r);
    EXPECT_NEAR(sums(far).r, 1, 1e-6);
    EXPECT_NEAR(sums(far).b, 1, 1e-6);
    choice.kernel_images.near = std::make_shared<const Picture>(32, 32, Rgba{1, 1, 1, 1});
    EXPECT_TRUE(spread(choice, -20).neutral);
}

TEST(KernelImage, WithoutAFarPictureOrLightIsRefused) {
    LensChoice choice;
    choice.kernel_images.near = std::make_shared<const Picture>(8, 8, Rgba{1, 1, 1, 1});
    EXPECT_FALSE(make_lens(choice, full_frame()));
    choice.kernel_images.far = std::make_shared<const Picture>(8, 8, Rgba{1, 0, 1, 1});
    EXPECT_FALSE(make_lens(choice, full_frame()));
}

TEST(Pupil, NumbersOutOfRangeAreRefusedByName) {
    const auto message = [](auto set) { return make_lens(with(set), full_frame()).error().message; };
    const auto names = [](const std::string& text, const char* flag) {
        return text.find(flag) != std::string::npos;
    };
    EXPECT_TRUE(names(message([](LensChoice& c) { c.barn_doors.left = 2; }), "lens.barn_doors"));
    EXPECT_TRUE(names(message([](LensChoice& c) { c.barn_doors = {1, 1, 0, 0}; }), "lens.barn_doors"));
    EXPECT_TRUE(names(message([](LensChoice& c) { c.texture.dust = 1.5; }), "lens.dust"));
    EXPECT_TRUE(names(message([](LensChoice& c) { c.aperture = {.blades = 5, .rotation_deg = 1e300}; }),
                      "lens.blade_rotation_deg"));
    EXPECT_TRUE(names(message([](LensChoice& c) { c.barrel = {{-1, 3}}; }), "lens.barrel"));
    EXPECT_TRUE(names(message([](LensChoice& c) { c.aperture.round_at_f_number = -1; }), "lens.iris_open"));
}

}  // namespace
}  // namespace petzval::kernel
