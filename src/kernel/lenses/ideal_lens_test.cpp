// The laws of the perfect lens: area, energy, orientation, and the agreement of both ways to see it.
#include "kernel/lenses/ideal_lens.h"

#include "kernel/lenses/make_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

constexpr double kPi = std::numbers::pi;
const Mount kMount{.camera = {50, 36, 2, 2}, .display_width_px = 1920, .display_height_px = 1080};

std::unique_ptr<const LensModel> lens_of(const LensChoice& choice, double pixel_aspect = 1) {
    Mount mount = kMount;
    mount.pixel_aspect = pixel_aspect;
    return std::move(make_lens(choice, mount)).value();
}

double sum(const PointSpread& s) {
    double total = 0;
    for (int y = 0; y < s.weights.height(); ++y)
        for (int x = 0; x < s.weights.width(); ++x) total += s.weights(x, y).g;
    return total;
}

float weight_at(const PointSpread& s, int dx, int dy) {
    return s.extent.contains(dx, dy) ? s.weights(dx - s.extent.x0, dy - s.extent.y0).g : 0.0f;
}

// Centre of gravity and mean square distance from it, of squares of side 1.
struct Moments {
    double x = 0, y = 0, xx = 0, yy = 0;
};
Moments moments(const PointSpread& s) {
    Moments m;
    for (int y = s.extent.y0; y < s.extent.y1; ++y)
        for (int x = s.extent.x0; x < s.extent.x1; ++x) {
            const double w = weight_at(s, x, y);
            m.x += w * x, m.y += w * y, m.xx += w * x * x, m.yy += w * y * y;
        }
    return m;
}

// Share of the pixel at (dx, dy) inside a disc, by 400 x 400 points.
double sampled_disc_share(double radius, int dx, int dy) {
    int inside = 0;
    for (int j = 0; j < 400; ++j)
        for (int i = 0; i < 400; ++i)
            if (std::hypot(dx - 0.5 + (i + 0.5) / 400, dy - 0.5 + (j + 0.5) / 400) <= radius) ++inside;
    return inside / 160000.0;
}

TEST(IdealLens, WeightsSumToOneForEveryShapeSizeAndPlace) {
    for (const int blades : {0, 3, 5, 6, 9})
        for (const double curvature : {0.0, 0.4, 1.0})
            for (const double cats_eye : {0.0, 0.5, 1.0})
                for (const double radius : {0.0, 1e-7, 0.3, 0.5, 0.51, 1.0, 2.7, 17.3, -17.3, 60.0}) {
                    LensChoice choice;
                    choice.aperture = {.blades = blades, .rotation_deg = 10, .curvature = curvature};
                    choice.cats_eye = cats_eye;
                    const PointSpread s = lens_of(choice)->point_spread(radius, {0.6, -0.3});
                    EXPECT_NEAR(sum(s), 1, 1e-6) << blades << " " << curvature << " " << radius;
                    for (int y = 0; y < s.weights.height(); ++y)
                        for (int x = 0; x < s.weights.width(); ++x) ASSERT_GE(s.weights(x, y).g, 0);
                }
}

TEST(IdealLens, WeightOfAPixelIsTheShareOfTheDiscInItsSquare) {
    for (const double radius : {0.6, 1.3, 4.0, 9.71}) {
        const PointSpread s = lens_of({})->point_spread(radius, {});
        const int reach = int(std::ceil(radius)) + 1;
        for (int dy = -reach; dy <= reach; dy += 3)
            for (int dx = -reach; dx <= reach; ++dx) {
                const double expected = sampled_disc_share(radius, dx, dy) / (kPi * radius * radius);
                EXPECT_NEAR(weight_at(s, dx, dy), expected, 1e-3 / (kPi * radius * radius));
            }
    }
}

TEST(IdealLens, RadiusZeroIsOnePixelOfWeightOne) {
    const PointSpread s = lens_of({})->point_spread(0, {});
    EXPECT_EQ(s.extent, (Rect{0, 0, 1, 1}));
    EXPECT_EQ(s.weights(0, 0), (Rgba{1, 1, 1, 1}));
}

TEST(IdealLens, SecondMomentOfADiscIsAQuarterOfItsRadiusSquaredPerAxis) {
    const Moments m = moments(lens_of({})->point_spread(20, {}));
    // Counting all light of a square at its centre adds 1/12.
    EXPECT_NEAR(m.xx - 1.0 / 12, 100, 0.01);
    EXPECT_NEAR(m.yy - 1.0 / 12, 100, 0.01);
}

TEST(IdealLens, PolygonIsInscribedAndFallsIntoADiscAsItsBladesBend) {
    LensChoice square;
    square.aperture = {.blades = 4};  // first vertex on +x: corners on the axes, area 2 r^2
    const PointSpread s = lens_of(square)->point_spread(20, {});
    EXPECT_NEAR(weight_at(s, 0, 0), 1 / 800.0, 1e-6);
    EXPECT_GT(weight_at(s, 19, 0), 0);
    EXPECT_EQ(weight_at(s, 14, 14), 0);
    square.aperture.curvature = 1;
    const PointSpread round = lens_of(square)->point_spread(20, {});
    const PointSpread disc = lens_of({})->point_spread(20, {});
    ASSERT_EQ(round.extent, disc.extent);
    for (int y = -20; y <= 20; ++y)
        for (int x = -20; x <= 20; ++x)
            EXPECT_NEAR(weight_at(round, x, y), weight_at(disc, x, y), 1e-3 * weight_at(disc, 0, 0));
}

TEST(IdealLens, AFiveBladedApertureIsUprightBehindFocusAndTurnedInFront) {
    LensChoice pentagon;
    pentagon.aperture = {.blades = 5, .rotation_deg = 90};  // first vertex up
    const auto lens = lens_of(pentagon);
    const PointSpread far = lens->point_spread(20, {}), near = lens->point_spread(-20, {});
    EXPECT_GT(weight_at(far, 0, -19), 0);  // up is -y in pixels
    EXPECT_EQ(weight_at(far, 0, 19), 0);
    EXPECT_GT(weight_at(near, 0, 19), 0);
    EXPECT_EQ(weight_at(near, 0, -19), 0);
}

TEST(IdealLens, RotationTurnsCounterClockwiseAsSeen) {
    LensChoice triangle;
    triangle.aperture = {.blades = 3, .rotation_deg = 30};
    const PointSpread s = lens_of(triangle)->point_spread(40, {});
    // The first vertex lies at 30 degrees: right and up.
    EXPECT_GT(weight_at(s, 33, -19), 0);
    EXPECT_EQ(weight_at(s, 33, 19), 0);
}

TEST(IdealLens, CatsEyeKeepsTheSideOfTheBarrelAndSwapsItThroughFocus) {
    LensChoice choice;
    choice.cats_eye = 0.8;
    const auto lens = lens_of(choice);
    EXPECT_TRUE(lens->varies_over_field());
    // The rim stands in front and is seen at -0.8 in x: what is right of its circle's edge at x = 0.2 is cut.
    const PointSpread far = lens->point_spread(20, {1, 0}), near = lens->point_spread(-20, {1, 0});
    EXPECT_EQ(weight_at(far, 6, 0), 0);
    EXPECT_GT(weight_at(far, 3, 0), 0);
    EXPECT_GT(weight_at(far, -19, 0), 0);
    EXPECT_EQ(weight_at(near, -6, 0), 0);
    EXPECT_GT(weight_at(near, -3, 0), 0);
    // Field y is up, pixel y is down.
    EXPECT_GT(weight_at(lens->point_spread(20, {0, 1}), 0, 19), 0);
    EXPECT_EQ(weight_at(lens->point_spread(20, {0, 1}), 0, -6), 0);
    // In the centre nothing is cut.
    EXPECT_NEAR(weight_at(lens->point_spread(20, {0, 0}), 0, 0), 1 / (kPi * 400), 1e-6);
}

TEST(IdealLens, ACatsEyeIsARimInFrontOfThePupil) {
    // 50 mm f/2 has a pupil of 12.5 mm, and a rim displaced by all of it at the corner: 12.5 = distance tan.
    LensChoice drawn, built;
    drawn.cats_eye = 1;
    const double tangent = 0.5 * 36 * std::hypot(1, 9.0 / 16) / 50;
    built.barrel = {{12.5, 12.5 / tangent}};
    for (const double radius : {-20.0, 20.0}) {
        const PointSpread a = lens_of(drawn)->point_spread(radius, {0.5, 0.3});
        const PointSpread b = lens_of(built)->point_spread(radius, {0.5, 0.3});
        for (int y = -21; y <= 21; ++y)
            for (int x = -21; x <= 21; ++x) EXPECT_NEAR(weight_at(a, x, y), weight_at(b, x, y), 1e-6);
    }
}

TEST(IdealLens, LensShapedOverlapHasTheAreaOfTwoCircles) {
    LensChoice choice;
    choice.cats_eye = 1;
    const PointSpread s = lens_of(choice)->point_spread(30, {1, 0});
    // Two unit circles at distance 1: 2 acos(1/2) - sqrt(3)/2.
    EXPECT_NEAR(weight_at(s, -15, 0) * 900, 1 / (2 * kPi / 3 - std::sqrt(3) / 2), 1e-4);
}

TEST(IdealLens, SqueezeAndPixelAspectShapeTheDisc) {
    LensChoice anamorphic;
    anamorphic.aperture.squeeze = 2;
    const Moments tall = moments(lens_of(anamorphic)->point_spread(20, {}));
    EXPECT_NEAR(tall.yy / tall.xx, 4, 0.02);
    const Moments stretched = moments(lens_of({}, 2)->point_spread(20, {}));
    EXPECT_NEAR(stretched.xx - 1.0 / 12, 100, 0.02);  // the horizontal radius stays
    EXPECT_NEAR(stretched.yy - 1.0 / 12, 400, 0.08);
}

TEST(IdealLens, RaysLandWhereTheKernelSays) {
    LensChoice choice;
    choice.aperture = {.blades = 6, .rotation_deg = 7, .curvature = 0.3, .squeeze = 1.4};
    choice.cats_eye = 0.7;
    const auto lens = lens_of(choice, 1.2);
    const FieldPosition field{0.5, 0.6};
    const PointSpread s = lens->point_spread(-6.4, field);
    Image<float> histogram(s.weights.width(), s.weights.height());
    double total = 0;
    for (const PupilRay& ray : lens->rays(1 << 16, field, 3)) {
        const int x = int(std::floor(-6.4 * ray.x + ray.offset_x_px + 0.5)) - s.extent.x0;
        const int y = int(std::floor(-6.4 * ray.y + ray.offset_y_px + 0.5)) - s.extent.y0;
        ASSERT_TRUE(histogram.rect().contains(x, y));
        histogram(x, y) += ray.weight.g;
        total += double(ray.weight.g);
    }
    EXPECT_NEAR(total, 1, 1e-6);
    for (int y = 0; y < histogram.height(); ++y)
        for (int x = 0; x < histogram.width(); ++x)
            EXPECT_NEAR(histogram(x, y), s.weights(x, y).g, 3e-4) << x << " " << y;
}

TEST(IdealLens, RaysAreTheSameForTheSameSeedAndOthersForAnother) {
    const auto lens = lens_of({});
    const auto a = lens->rays(64, {}, 5), b = lens->rays(64, {}, 5), c = lens->rays(64, {}, 6);
    bool differs = false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].x, b[i].x);
        differs = differs || a[i].x != c[i].x;
        EXPECT_LE(std::hypot(a[i].x, a[i].y), 1.0001);
    }
    EXPECT_TRUE(differs);
}

TEST(IdealLens, NothingReachesBeyondItsReach) {
    LensChoice choice;
    choice.aperture = {.blades = 5, .squeeze = 0.5};
    const auto lens = lens_of(choice, 2);
    const PointSpread s = lens->point_spread(10, {});
    const double reach = lens->reach_px(10);
    EXPECT_LE(std::max({-s.extent.x0, -s.extent.y0, s.extent.x1 - 1, s.extent.y1 - 1}), reach + 0.5);
}

TEST(IdealLens, EveryPointOfThePupilLandsAtItselfTimesTheRadius) {
    LensChoice choice;
    choice.cats_eye = 0.7;
    const IdealLens lens(choice, kMount);
    EXPECT_TRUE(lens.is_perfect());
    const Point landed = lens.landing(450, 7, {0.5, 0.3})({0.25, -0.5});
    EXPECT_DOUBLE_EQ(landed.x, 1.75);
    EXPECT_DOUBLE_EQ(landed.y, -3.5);
}

TEST(MakeLens, AnUnknownNameListsTheKnownOnes) {
    LensChoice choice;
    choice.name = "kaleidoscope";
    const auto lens = make_lens(choice, kMount);
    ASSERT_FALSE(lens);
    EXPECT_NE(lens.error().message.find("kaleidoscope"), std::string::npos);
    EXPECT_NE(lens.error().message.find("ideal"), std::string::npos);
}

TEST(MakeLens, NumbersOutOfRangeAreRefusedByName) {
    LensChoice choice;
    choice.aperture.blades = 2;
    EXPECT_NE(make_lens(choice, kMount).error().message.find("lens.blades"), std::string::npos);
    choice = {};
    choice.cats_eye = std::nan("");
    EXPECT_NE(make_lens(choice, kMount).error().message.find("lens.cats_eye"), std::string::npos);
    choice = {};
    choice.aperture.squeeze = 0;
    EXPECT_NE(make_lens(choice, kMount).error().message.find("lens.squeeze"), std::string::npos);
}

}  // namespace
}  // namespace petzval::kernel
