// Added aberrations: by hand, by independent rays, by waves, and the same on every kind of lens.
#include "kernel/lenses/third_order.h"

#include "kernel/lenses/geometric_lens.h"
#include "kernel/lenses/kernel_testing.h"
#include "kernel/lenses/wave_lens.h"

#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi, kPxPerMm = 1920 / 36.0, kD_nm = 587.56;
constexpr FieldPosition kOff{0.5, 0.3};

LensChoice named(const std::string& name) {
    LensChoice choice;
    choice.name = name;
    return choice;
}

// The defocus-control ring turned, on a lens of each kind that opens to f/2.8.
const char* const kKinds[] = {"ideal", "doublet", "petzval-projection"};
Mount mount() { return full_frame(2.8); }

using Change = void (*)(LensChoice&);
constexpr Change kChanges[] = {[](LensChoice& c) { c.added.spherical_waves = 20; },
                               [](LensChoice& c) { c.added.axial_colour_mm = -0.5; },
                               [](LensChoice& c) { c.added.field_curvature_mm = -1; },
                               [](LensChoice& c) { c.added.lateral_colour_percent = 0.5; },
                               [](LensChoice& c) { c.coma = 2; },
                               [](LensChoice& c) { c.astigmatism = 2; }};

Point lands(const LensChoice& choice, Point pupil, double nm = kD_nm, FieldPosition field = {},
            const Mount& on = mount()) {
    const auto lens = lens_of(choice, on);
    return dynamic_cast<const GeometricLens&>(*lens).landing(nm, 10, field)(pupil);
}

TEST(ThirdOrder, PolynomialsAreTheFormula) {
    LensChoice choice;
    for (const Change change : kChanges) change(choice);
    choice.focus_mode = FocusMode::Paraxial;
    const ThirdOrder added(choice, mount(), 50);
    for (const Point p : {Point{0.3, 0.4}, {-0.9, 0.1}, {0.2, -0.8}}) {
        const double square = p.x * p.x + p.y * p.y, field = 0.7, colour = 0.4;
        const double scale =
            added.spherical * square + added.axial_colour * colour + added.curvature * field * field;
        const Point expected = added.landed(scale, p, field, colour);
        const Point at = added.polynomial(field, colour).at(PupilPowers(p));
        EXPECT_NEAR(at.x, expected.x, 1e-12);
        EXPECT_NEAR(at.y, expected.y, 1e-12);
        // Turned with the field.
        const double c = std::cos(0.6), s = std::sin(0.6);
        const auto turned = [&](Point q) { return Point{c * q.x - s * q.y, s * q.x + c * q.y}; };
        const Point there = added.polynomial(field, colour, {c, s}).at(PupilPowers(turned(p)));
        EXPECT_NEAR(there.x, turned(expected).x, 1e-12);
        EXPECT_NEAR(there.y, turned(expected).y, 1e-12);
    }
}

TEST(ThirdOrder, SizesAreThoseByHand) {
    LensChoice choice;
    choice.focus_mode = FocusMode::Paraxial;
    // W040 = 1 wave at f/2: the rim lands 8 N W = 8 * 2 * 0.58756 um = 9.401 um outward.
    choice.added.spherical_waves = 1;
    EXPECT_NEAR(lands(choice, {1, 0}, kD_nm, {}, full_frame(2)).x - 10, 9.40096e-3 * kPxPerMm, 1e-6);
    EXPECT_NEAR(lands(choice, {0.5, 0}, kD_nm, {}, full_frame(2)).x - 5, 9.40096e-3 * kPxPerMm / 8, 1e-4);
    // Stated for f/2, at f/4: a sixteenth of the wave, on rays twice as flat.
    choice.added.at_f_number = 2;
    EXPECT_NEAR(lands(choice, {1, 0}, kD_nm, {}, full_frame(4)).x - 10, 9.40096e-3 / 8 * kPxPerMm, 1e-6);
    // A focus 1 mm before the sensor at f/2.8: the rim lands 1/5.6 mm farther out.
    choice.added = {.field_curvature_mm = -1};
    EXPECT_NEAR(lands(choice, {1, 0}, kD_nm, {1, 0}).x - 10, kPxPerMm / 5.6, 1e-9);
    EXPECT_NEAR(lands(choice, {1, 0}, kD_nm, {0.5, 0}).x - 10, kPxPerMm / 5.6 / 4, 1e-9);
    choice.added = {.axial_colour_mm = -1};
    EXPECT_NEAR(lands(choice, {1, 0}, 486.13).x - lands(choice, {1, 0}, 656.27).x, kPxPerMm / 5.6, 1e-6);
    // The corner of 1920 x 1080 pixels lies 1101.45 px out: 1 % of it.
    choice.added = {.lateral_colour_percent = 1};
    EXPECT_NEAR(lands(choice, {}, 486.13, {1, 0}).x - lands(choice, {}, 656.27, {1, 0}).x, 11.0145, 1e-3);
    EXPECT_NEAR(lands(choice, {}, kD_nm, {1, 0}).x, 0, 1e-9);
}

TEST(ThirdOrder, EveryKindOfLensGetsTheSame) {
    const auto landings = [](const LensChoice& choice) {
        const auto lens = lens_of(choice, mount());
        std::vector<Point> all;
        for (const double nm : {440.0, 546.0, 650.0})
            for (const Point p : {Point{0.9, 0}, {-0.3, 0.5}})
                all.push_back(dynamic_cast<const GeometricLens&>(*lens).landing(nm, 10, kOff)(p));
        return all;
    };
    for (const FocusMode mode : {FocusMode::Paraxial, FocusMode::Best}) {
        std::vector<Point> on_ideal;
        for (const char* name : kKinds) {
            LensChoice plain = named(name), turned = plain;
            plain.focus_mode = turned.focus_mode = mode;
            for (const Change change : kChanges) change(turned);
            std::vector<Point> added = landings(turned);
            const std::vector<Point> before = landings(plain);
            for (std::size_t i = 0; i < added.size(); ++i) added[i] = added[i] - before[i];
            if (on_ideal.empty()) on_ideal = added;
            for (std::size_t i = 0; i < added.size(); ++i) {
                EXPECT_NEAR(added[i].x, on_ideal[i].x, 2e-3) << name << " " << i;
                EXPECT_NEAR(added[i].y, on_ideal[i].y, 2e-3) << name << " " << i;
            }
        }
    }
}

// Light that falls on pixels, of a pupil sampled so finely that it is even: no ring or mesh of the program.
PointSpread sampled(double coc_px, double rim_px, const Rect& extent) {
    constexpr int kSide = 1500;
    PointSpread spread{extent, Image<Rgba>(extent.width(), extent.height()), true};
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const Point p{2 * (i + 0.5) / kSide - 1, 2 * (j + 0.5) / kSide - 1};
            const double square = p.x * p.x + p.y * p.y;
            if (square > 1) continue;
            const Point at = (coc_px + rim_px * square) * p;
            const int x = int(std::lround(at.x)) - extent.x0, y = int(std::lround(at.y)) - extent.y0;
            if (spread.weights.rect().contains(x, y)) spread.weights(x, y).g += 1;
        }
    for (std::size_t i = 0; i < spread.weights.size(); ++i)
        spread.weights.pixels()[i].g /= float(0.25 * kPi * kSide * kSide);
    return spread;
}

TEST(ThirdOrder, ADiscIsWhatThePupilSampledPointByPointThrows) {
    LensChoice choice;
    choice.focus_mode = FocusMode::Paraxial;
    for (const double waves : {20.0, -20.0})
        for (const double coc : {-16.0, 0.0, 16.0}) {
            choice.added.spherical_waves = waves;
            const double rim = 9.40096e-3 * waves * kPxPerMm;  // by hand, as above
            const PointSpread made = lens_of(choice, full_frame(2))->point_spread(coc, {});
            const PointSpread truth = sampled(coc, rim, made.extent);
            double elsewhere = 0;
            for (std::size_t i = 0; i < truth.weights.size(); ++i)
                elsewhere += 0.5 * std::abs(double(truth.weights.pixels()[i].g - made.weights.pixels()[i].g));
            EXPECT_LT(elsewhere, 0.01) << waves << " " << coc;
            // In closed form: the mean of (c rho + S rho^3)^2 over the pupil, and a pixel's own 1/6.
            const Moments m = moments(made);
            EXPECT_NEAR(m.xx + m.yy, coc * coc / 2 + 2 * coc * rim / 3 + rim * rim / 4 + 1.0 / 6,
                        2e-3 * (coc * coc + rim * rim));
            EXPECT_NEAR(sums(made).r, sums(made).g, 1e-6);
        }
}

TEST(ThirdOrder, OneWaveOfItDimsTheFocusAsFresnelsIntegralsSay) {
    // The middle of the paraxial focus: |integral of exp(2 pi i t) over t = rho^2 in 0...1 with the phase
    // W040 t^2|^2 = (C(2)^2 + S(2)^2)/4 with C(2) = 0.488253, S(2) = 0.343416 (Abramowitz, Stegun, table
    // 7.7).
    const Mount fine{.camera = {8, 4.8, 8, 2}, .display_width_px = 9600, .display_height_px = 7200};
    const auto middle = [&](double waves) {
        LensChoice choice;
        choice.focus_mode = FocusMode::Paraxial;
        choice.added.spherical_waves = waves;
        auto lens = lens_of(choice, fine);
        const auto* rays = dynamic_cast<const GeometricLens*>(lens.release());
        const WaveLens wave(std::unique_ptr<const GeometricLens>(rays), fine);
        return double(weight_at(wave.monochromatic(kD_nm, 0, {}, {-250, -250, 251, 251}), 0, 0).g);
    };
    const double expected = (0.488253 * 0.488253 + 0.343416 * 0.343416) / 4;
    EXPECT_NEAR(middle(1) / middle(0), expected, 0.02 * expected);
    EXPECT_NEAR(middle(-1) / middle(0), expected, 0.02 * expected);
}

TEST(ThirdOrder, KernelsKeepTheirEnergyAndRaysSumToThem) {
    for (const char* name : kKinds) {
        LensChoice choice = named(name);
        for (const Change change : kChanges) change(choice);
        const auto lens = lens_of(choice, mount());
        for (const double coc : {-9.0, 0.0, 9.0}) {
            const PointSpread s = lens->point_spread(coc, kOff), raw = lens->raw_point_spread(coc, kOff);
            const Sums t = sums(s);
            for (const double sum : {t.r, t.g, t.b}) EXPECT_NEAR(sum, 1, 1e-5) << name;
            EXPECT_GE(t.least, 0);
            const double reach = lens->reach_px(coc) + 0.5;
            EXPECT_LE(std::max({-s.extent.x0, -s.extent.y0, s.extent.x1 - 1, s.extent.y1 - 1}), reach);
            Moments of_rays;
            for (const PupilRay& ray : lens->rays(1 << 15, kOff, 1)) {
                const double x = coc * double(ray.x) + double(ray.offset_x_px);
                const double y = coc * double(ray.y) + double(ray.offset_y_px), w = double(ray.weight.a);
                of_rays.x += w * x, of_rays.y += w * y, of_rays.xx += w * x * x, of_rays.yy += w * y * y;
            }
            const Moments m = moments(raw);
            EXPECT_NEAR(m.x, of_rays.x, 0.1) << name << coc;
            EXPECT_NEAR(m.y, of_rays.y, 0.1) << name << coc;
            EXPECT_NEAR(m.xx - 1.0 / 12, of_rays.xx, 0.03 * m.xx) << name << coc;
            EXPECT_NEAR(m.yy - 1.0 / 12, of_rays.yy, 0.03 * m.yy) << name << coc;
        }
    }
}

TEST(ThirdOrder, EachChangesEveryLensAndNothingAddedChangesNoBit) {
    for (const char* name : kKinds) {
        const PointSpread plain = lens_of(named(name), mount())->point_spread(12, kOff);
        const bool is_traced = std::string(name) == kKinds[2];  // slow, and the same as the others
        for (std::size_t i = 0; i < (is_traced ? 1 : std::size(kChanges)); ++i) {
            LensChoice choice = named(name);
            kChanges[i](choice);
            const PointSpread changed = lens_of(choice, mount())->point_spread(12, kOff);
            EXPECT_GT(largest_difference(changed, plain), 0.02 * brightest(plain)) << name << " " << i;
        }
        LensChoice stated = named(name);
        stated.added.at_f_number = 4;
        EXPECT_EQ(largest_difference(lens_of(stated, mount())->point_spread(12, kOff), plain), 0) << name;
    }
}

TEST(ThirdOrder, WithBestFocusTheSensorStandsWhereTheBlurIsLeast) {
    LensChoice choice;
    choice.added.spherical_waves = 40, choice.added.axial_colour_mm = -1;
    const auto lens = lens_of(choice, mount());
    const auto blur = [&](double coc) {
        const Moments m = moments(lens->raw_point_spread(coc, {}));
        return m.xx + m.yy;
    };
    EXPECT_LT(blur(0), blur(1));
    EXPECT_LT(blur(0), blur(-1));
}

TEST(ThirdOrder, WhatWouldThrowLightOutOfThePictureIsRefused) {
    LensChoice choice;
    choice.added = {.spherical_waves = 100, .at_f_number = 64};
    const auto lens = make_lens(choice, full_frame(1.4));
    ASSERT_FALSE(lens);
    EXPECT_EQ(lens.error().field, "lens.added_spherical_waves");
    choice.added = {.lateral_colour_percent = 11};
    EXPECT_EQ(Lens::open(choice).error().field, "lens.added_lateral_colour_percent");
}

}  // namespace
}  // namespace petzval::kernel
