// The laws of curve lenses.
#include "kernel/lenses/curve_lens.h"

#include "kernel/lenses/kernel_testing.h"

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr FieldPosition kCorner{0.8, -0.6};

LensChoice named(const std::string& name) {
    LensChoice choice;
    choice.name = name;
    return choice;
}

// Mean square radius at best focus, less that of the pixel itself.
double blur_at_focus(const std::string& name, double f_number) {
    const Moments m = moments(lens_of(named(name), full_frame(f_number, 16000))->point_spread(0, {}));
    return std::sqrt(std::max(0.0, m.xx + m.yy - 1.0 / 6));
}

AberrationCurves third_order(double marginal_shift) {
    return {
        "third order", "", 50, 2, 36, {587.56}, {0, 0.125, 0.25}, {{0, marginal_shift / 4, marginal_shift}}};
}

// Steepness of the rim: the share of the rim's brightness lost within 1 px, from the last bright ring.
double edge_to_middle(const PointSpread& s, double coc_radius_px) {
    const std::vector<Rgba> profile = radial_profile(s, coc_radius_px);
    float rim = 0;
    for (std::size_t i = profile.size() / 2; i < profile.size(); ++i) rim = std::max(rim, profile[i].a);
    return double(rim) / double(profile[0].a);
}

TEST(CurveLens, EveryPresetKeepsItsEnergyInEveryChannelAndIsNowhereNegative) {
    for (const std::string& name : curve_preset_names())
        for (const double radius : {-40.0, -7.0, -0.8, 0.0, 0.8, 7.0, 40.0}) {
            const Sums t = sums(lens_named(name)->point_spread(radius, {}));
            EXPECT_NEAR(t.r, 1, 1e-6) << name << radius;
            EXPECT_NEAR(t.g, 1, 1e-6) << name << radius;
            EXPECT_NEAR(t.b, 1, 1e-6) << name << radius;
            EXPECT_NEAR(t.a, 1, 1e-6) << name << radius;
            EXPECT_GE(t.least, 0) << name << radius;
        }
}

TEST(CurveLens, WithoutResidualsItIsTheIdealLens) {
    LensChoice choice = named("doublet");
    choice.spherical = choice.axial_colour = 0;
    for (const double radius : {-12.3, 3.3, 30.0}) {
        const PointSpread disc = lens_of({})->point_spread(radius, {});
        EXPECT_LT(largest_difference(lens_of(choice)->point_spread(radius, {}), disc),
                  1e-3 * brightest(disc));
    }
}

TEST(CurveLens, SphericalAberrationAloneIsNeutral) {
    LensChoice choice = named("uncorrected");
    choice.axial_colour = 0;
    const PointSpread s = lens_of(choice)->raw_point_spread(25, {});
    for (std::size_t i = 0; i < s.weights.size(); ++i) {
        const Rgba w = s.weights.pixels()[i];
        ASSERT_NEAR(double(w.r), double(w.g), 1e-6 * brightest(s));
        ASSERT_NEAR(double(w.b), double(w.g), 1e-6 * brightest(s));
    }
}

TEST(CurveLens, MirrorLawReversedAberrationInFrontIsTheKernelBehind) {
    for (const std::string& name : curve_preset_names()) {
        LensChoice reversed = named(name);
        reversed.spherical = reversed.axial_colour = -1;
        const PointSpread in_front = lens_of(reversed)->point_spread(-18, {});
        const PointSpread behind = lens_named(name)->point_spread(18, {});
        EXPECT_LT(largest_difference(in_front, behind), 1e-6 * brightest(behind)) << name;
    }
}

TEST(CurveLens, MarginalFocusTowardsTheLensSharpensTheNearEdgeAwayTheFarEdge) {
    for (const double shift : {-0.01, 0.01}) {
        const CurveLens lens(third_order(shift), {}, full_frame());
        const double near = edge_to_middle(lens.point_spread(-20, {}), 20);
        const double far = edge_to_middle(lens.point_spread(20, {}), 20);
        EXPECT_GT(shift < 0 ? near : far, 1.3);
        EXPECT_LT(shift < 0 ? far : near, 0.8);
    }
}

TEST(CurveLens, ScalingFocalLengthAndFormatTogetherChangesNothing) {
    Mount small = full_frame();
    small.camera.focal_length_mm /= 6, small.camera.sensor_width_mm /= 6;
    const PointSpread a = lens_named("doublet")->point_spread(15, {});
    const PointSpread b = lens_of(named("doublet"), small)->point_spread(15, {});
    EXPECT_LT(largest_difference(a, b), 1e-6 * brightest(a));
}

TEST(CurveLens, SphericalBlurFallsWithTheCubeOfTheAperture) {
    LensChoice choice = named("doublet-overcorrected");
    const auto blur = [&](double f_number) {
        const CurveLens lens(third_order(0.02), {}, full_frame(f_number, 16000));
        const Moments m = moments(lens.point_spread(0, {}));
        return std::sqrt(m.xx + m.yy - 1.0 / 6);
    };
    EXPECT_NEAR(blur(2) / blur(4), 8, 0.1);
}

TEST(CurveLens, ColourBlurFallsWithTheAperture) {
    EXPECT_NEAR(blur_at_focus("asphere", 2) / blur_at_focus("asphere", 4), 2, 0.02);
}

// The sum over pixels and channels. (A rim's brightest pixel alone says how wide the rim is, not how much.)
double misplaced_light(const PointSpread& p, const PointSpread& q) {
    double sum = 0;
    const Rect e{std::min(p.extent.x0, q.extent.x0), std::min(p.extent.y0, q.extent.y0),
                 std::max(p.extent.x1, q.extent.x1), std::max(p.extent.y1, q.extent.y1)};
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x) {
            const Rgba a = weight_at(p, x, y), b = weight_at(q, x, y);
            sum += double(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b));
        }
    return sum;
}

TEST(CurveLens, StoppingDownConvergesToTheIdealLens) {
    for (const std::string& name : curve_preset_names()) {
        const PointSpread disc = lens_of({})->point_spread(20, {});
        double before = 1e9;
        for (const double f_number : {4.0, 11.0, 64.0, 1000.0}) {
            const double now = misplaced_light(lens_named(name, f_number)->point_spread(20, {}), disc);
            EXPECT_LT(now, before) << name << " f/" << f_number;
            before = now;
        }
        EXPECT_LT(largest_difference(lens_named(name, 1000)->point_spread(20, {}), disc),
                  0.05 * brightest(disc))
            << name;
    }
}

TEST(CurveLens, LargeDefocusFlattensTheDisc) {
    // Contrast of a doublet's core against half of the radius.
    const auto unevenness = [](double radius) {
        const auto profile = radial_profile(lens_named("doublet", 2.8)->point_spread(radius, {}), radius);
        return std::abs(double(profile[0].a / profile[profile.size() / 2].a) - 1);
    };
    EXPECT_GT(unevenness(12), unevenness(30));
    EXPECT_GT(unevenness(30), 2 * unevenness(120));
}

TEST(CurveLens, RelativeColourFallsWithDefocusAndWhenStoppedDown) {
    const auto colour = [](double radius, double f_number) {
        float sum = 0;
        for (const Rgba& c :
             radial_profile(lens_named("doublet", f_number)->point_spread(radius, {}), radius))
            sum += std::abs(c.r - c.g) + std::abs(c.b - c.g);
        return sum / float(radius);
    };
    for (const double side : {-1.0, 1.0}) {
        const auto of = [&](double radius, double f_number) {
            return std::abs(colour(side * radius, f_number));
        };
        EXPECT_GT(of(15, 2), 1.5f * of(40, 2));
        EXPECT_GT(of(40, 2), 1.5f * of(120, 2));
        EXPECT_GT(of(15, 2), 1.5f * of(15, 5.6));
    }
}

TEST(CurveLens, FiveBladesTurnOverThroughFocusSixAndEightDoNot) {
    const auto flipped_difference = [](int blades) {
        LensChoice choice;
        choice.aperture.blades = blades;
        const auto lens = lens_of(choice);
        const PointSpread near = lens->point_spread(-20, {}), far = lens->point_spread(20, {});
        double turned = 0, same = 0;
        for (int y = -21; y <= 21; ++y)
            for (int x = -21; x <= 21; ++x) {
                const double n = double(weight_at(near, x, y).a);
                turned = std::max(turned, std::abs(n - double(weight_at(far, -x, -y).a)));
                same = std::max(same, std::abs(n - double(weight_at(far, x, y).a)));
            }
        return std::pair{turned / brightest(far), same / brightest(far)};
    };
    for (const int blades : {5, 6, 7, 8}) {
        const auto [turned, same] = flipped_difference(blades);
        EXPECT_LT(turned, 1e-4) << blades;
        if (blades % 2 == 0) {
            EXPECT_LT(same, 1e-4) << blades;
        } else {
            EXPECT_GT(same, 0.5) << blades;
        }
    }
}

TEST(CurveLens, ResidualsGoContinuouslyThroughZeroToReversed) {
    // Share of the light, in all channels, that lies elsewhere.
    const auto moved = [](const PointSpread& p, const PointSpread& q) {
        double sum = 0;
        for (int y = -60; y <= 60; ++y)
            for (int x = -60; x <= 60; ++x) {
                const Rgba d = weight_at(p, x, y) - weight_at(q, x, y);
                sum += std::abs(double(d.r)) + std::abs(double(d.g)) + std::abs(double(d.b));
            }
        return sum / 6;
    };
    for (const bool colour : {false, true}) {
        const auto at = [&](double factor) {
            LensChoice choice = named("uncorrected");
            choice.wavelengths = 62;
            choice.focus_mode = FocusMode::Paraxial;
            (colour ? choice.axial_colour : choice.spherical) = factor;
            return lens_of(choice)->point_spread(18, {});
        };
        EXPECT_GT(moved(at(1), at(-1)), colour ? 0.15 : 0.5);
        PointSpread before = at(1.2);
        for (double factor = 1.1; factor > -1.25; factor -= 0.1) {
            PointSpread here = at(factor);
            EXPECT_GT(moved(here, before), 1e-3) << factor;
            EXPECT_LT(moved(here, before), 0.25) << factor;
            before = std::move(here);
        }
    }
}

TEST(CurveLens, ComaLeavesOneBrightEdgeAndATailThatFades) {
    LensChoice choice = named("ideal");
    choice.coma = 0.8;
    const PointSpread s = lens_of(choice)->point_spread(12, {0.9, 0});
    double inner = 0, outer = 0;  // brightest towards the middle of the picture, and towards its edge
    for (int y = s.extent.y0; y < s.extent.y1; ++y)
        for (int x = s.extent.x0; x < s.extent.x1; ++x)
            (x < 0 ? inner : outer) = std::max(x < 0 ? inner : outer, double(weight_at(s, x, y).a));
    EXPECT_GT(inner, 1.5 * outer);
    EXPECT_GT(s.extent.x1, -s.extent.x0) << "the tail points outward";
}

TEST(CurveLens, DistortionStretchesDiscsAlongTheField) {
    LensChoice choice = named("ideal");
    choice.distortion = 0.1;
    const Moments right = moments(lens_of(choice)->point_spread(20, {1, 0})),
                  up = moments(lens_of(choice)->point_spread(20, {0, 1}));
    EXPECT_NEAR(std::sqrt(right.xx / right.yy), 1.3 / 1.1, 0.01);
    EXPECT_NEAR(std::sqrt(up.yy / up.xx), 1.3 / 1.1, 0.01);
}

TEST(CurveLens, BestFocusBlursLessThanAnyOtherPlace) {
    for (const std::string& name : curve_preset_names()) {
        LensChoice choice = named(name);
        const auto blur = [&](double coc) {
            const Moments m = moments(lens_of(choice, full_frame(2, 8000))->raw_point_spread(coc, {}));
            return m.xx + m.yy;
        };
        const double best = blur(0);
        EXPECT_LE(best, blur(2) * (1 + 1e-3)) << name;
        EXPECT_LE(best, blur(-2) * (1 + 1e-3)) << name;
    }
}

TEST(CurveLens, AShiftOfTheSensorIsAShiftOfTheDefocus) {
    LensChoice paraxial = named("uncorrected"), shifted = paraxial;
    paraxial.focus_mode = FocusMode::Paraxial;
    shifted.focus_mode = FocusMode::Shift;
    shifted.focus_shift_mm = -0.3;
    // K = 0.25 * 50/36 * 1920 px; the sensor 0.3/50 f nearer to the lens adds K * shift to every radius.
    const double shift_px = 0.25 * 50 / 36 * 1920 * -0.3 / 50;
    const PointSpread a = lens_of(shifted)->point_spread(20, {});
    const PointSpread b = lens_of(paraxial)->point_spread(20 + shift_px, {});
    EXPECT_LT(largest_difference(a, b), 1e-4 * brightest(a));
}

TEST(CurveLens, RaysSumToTheRawKernel) {
    LensChoice choice = named("doublet");
    choice.aperture = {.blades = 5, .rotation_deg = 12, .curvature = 0.5};
    choice.cats_eye = 0.4, choice.coma = 0.7, choice.astigmatism = 0.4, choice.distortion = 0.05;
    Mount mount = full_frame();
    mount.pixel_aspect = 1.3;
    const auto lens = lens_of(choice, mount);
    const PointSpread s = lens->raw_point_spread(9, kCorner);
    Image<Rgba> histogram(s.weights.width(), s.weights.height());
    Moments of_rays;
    for (const PupilRay& ray : lens->rays(1 << 17, kCorner, 1)) {
        const float x = 9 * ray.x + ray.offset_x_px, y = 9 * ray.y + ray.offset_y_px;
        const int i = int(std::floor(x + 0.5f)) - s.extent.x0, j = int(std::floor(y + 0.5f)) - s.extent.y0;
        if (histogram.rect().contains(i, j)) histogram(i, j) += ray.weight;
        of_rays.xx += double(ray.weight.a * x * x), of_rays.yy += double(ray.weight.a * y * y);
    }
    double worst = 0;
    for (int y = 0; y < histogram.height(); ++y)
        for (int x = 0; x < histogram.width(); ++x)
            worst = std::max(worst, std::abs(double(histogram(x, y).g - s.weights(x, y).g)));
    EXPECT_LT(worst, 0.1 * brightest(s));
    const Moments m = moments(s);
    EXPECT_NEAR(m.xx - 1.0 / 12, of_rays.xx, 0.01 * m.xx);
    EXPECT_NEAR(m.yy - 1.0 / 12, of_rays.yy, 0.01 * m.yy);
}

TEST(CurveLens, FewRaysAreStillWhite) {
    for (const int count : {1, 2, 3, 7, 64}) {
        Rgba sum;
        for (const PupilRay& ray : lens_named("uncorrected")->rays(count, {}, 4)) sum += ray.weight;
        EXPECT_NEAR(double(sum.r), 1, 1e-5);
        EXPECT_NEAR(double(sum.g), 1, 1e-5);
        EXPECT_NEAR(double(sum.b), 1, 1e-5);
        EXPECT_NEAR(double(sum.a), 1, 1e-5);
    }
}

TEST(CurveLens, EveryOptionChangesTheKernelAndOffChangesNothing) {
    const PointSpread plain = lens_named("doublet")->point_spread(14, kCorner);
    const auto difference = [&](auto set) {
        LensChoice choice = named("doublet");
        set(choice);
        return largest_difference(lens_of(choice)->point_spread(14, kCorner), plain) / brightest(plain);
    };
    EXPECT_GT(difference([](LensChoice& c) { c.spherical = 0.5; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.axial_colour = 0.5; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.focus_mode = FocusMode::Paraxial; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.coma = 0.3; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.astigmatism = 0.3; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.distortion = 0.05; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.cats_eye = 0.3; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.aperture.blades = 6; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.aperture.squeeze = 1.5; }), 0.02);
    EXPECT_GT(difference([](LensChoice& c) { c.wavelengths = 3; }), 0.02);
    EXPECT_EQ(difference([](LensChoice& c) { c.coma = c.astigmatism = c.distortion = c.cats_eye = 0; }), 0);
}

TEST(CurveLens, MoreWavelengthsThanNeededChangeLittle) {
    LensChoice many = named("uncorrected"), more = many;
    many.wavelengths = 124, more.wavelengths = 248;
    const PointSpread a = lens_of(many)->point_spread(-20, {}), b = lens_of(more)->point_spread(-20, {});
    EXPECT_LT(largest_difference(a, b), 0.02 * brightest(a));
}

TEST(CurveLens, ComaDrawsItsTailOutwardOrInwardAndGrowsWithTheField) {
    LensChoice choice;
    choice.coma = 1;
    const auto pull = [&](FieldPosition field) { return moments(lens_of(choice)->point_spread(0, field)).x; };
    EXPECT_GT(pull({0.9, 0}), 1);
    EXPECT_NEAR(pull({0.45, 0}), 0.5 * pull({0.9, 0}), 0.02 * pull({0.9, 0}));
    EXPECT_LT(pull({-0.9, 0}), -1);
    choice.coma = -1;
    EXPECT_LT(pull({0.9, 0}), -1);
    EXPECT_LT(moments(lens_of(choice)->point_spread(0, {0, -0.9})).y, -1);  // inward from below is up
}

TEST(CurveLens, AstigmatismSwapsTheAxesOfTheEllipseThroughFocus) {
    LensChoice choice;
    choice.astigmatism = 1;
    const Moments far = moments(lens_of(choice)->point_spread(6, {1, 0}));
    const Moments near = moments(lens_of(choice)->point_spread(-6, {1, 0}));
    EXPECT_GT(far.yy, 2 * far.xx);
    EXPECT_GT(near.xx, 2 * near.yy);
}

TEST(CurveLens, AstigmatismHasTheSignOfATracedPetzvalLens) {
    // Behind focus, strokes round the middle: wider across the field's direction than along it.
    LensChoice petzval, swirl;
    petzval.name = "petzval-portrait", swirl.astigmatism = 1;
    const Moments traced = moments(lens_of(petzval, full_frame(3.6))->point_spread(15, {0.4, 0}));
    const Moments drawn = moments(lens_of(swirl)->point_spread(6, {0.7, 0}));
    const auto along = [](const Moments& m) { return m.xx - m.x * m.x; };
    EXPECT_GT(traced.yy, 2 * along(traced));
    EXPECT_GT(drawn.yy, 2 * along(drawn));
}

TEST(CurveLens, NothingLandsBeyondItsReach) {
    for (const std::string& name : curve_preset_names()) {
        LensChoice choice = named(name);
        choice.coma = 0.5, choice.astigmatism = -0.5, choice.distortion = 0.1, choice.cats_eye = 0.2;
        const auto lens = lens_of(choice);
        for (const double radius : {-15.0, 0.0, 15.0}) {
            const Rect e = lens->point_spread(radius, kCorner).extent;
            EXPECT_LE(std::max({-e.x0, -e.y0, e.x1 - 1, e.y1 - 1}), lens->reach_px(radius) + 0.5);
        }
    }
}

TEST(CurveLens, WiderThanDrawnForStretchesTheCurvesAndSaysSo) {
    EXPECT_EQ(lens_named("doublet", 2)->description().find("extended"), std::string::npos);
    EXPECT_NE(lens_named("doublet", 1.4)->description().find("extended"), std::string::npos);
}

TEST(CurveLens, OfTheIdealLensDoesNotDenyWhatWasAdded) {
    LensChoice choice = named("ideal");
    choice.added.spherical_waves = 30;
    EXPECT_EQ(lens_of(choice)->description(), "ideal: no aberrations except those added");
}

TEST(Curves, DamagedCurvesAreRefused) {
    AberrationCurves curves = third_order(0.01);
    EXPECT_TRUE(optics::check(curves));
    curves.shift[0].pop_back();
    EXPECT_FALSE(optics::check(curves));
    curves = third_order(0.01), curves.pupil_height = {0, 0.1, 0.1};
    EXPECT_FALSE(optics::check(curves));
    curves = third_order(0.01), curves.f_number = 1;  // its rim is beyond the last height
    EXPECT_FALSE(optics::check(curves));
    curves = third_order(0.01), curves.shift[0][1] = std::nan("");
    EXPECT_FALSE(optics::check(curves));
}

}  // namespace
}  // namespace petzval::kernel
