// Styles of the Gaussian engine that the laws of every engine do not see; the published one against the
// published formulas.
#include "shots.h"

#include <limits>

namespace petzval::conformance {
namespace {

const GaussianStyle kStyles[] = {GaussianStyle::Plain, GaussianStyle::Wgld};

DefocusJob job_of(const Shot& shot, GaussianStyle style) {
    DefocusJob job = shot.job("gaussian");
    job.gaussian.style = style;
    return job;
}

// Depth 1…3 m from left to right, focus at 2 m.
struct DepthShot {
    Picture colour{100, 40};
    Plane depth_m{100, 40};
    DepthShot() {
        paint_noise(colour, 4);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 100; ++x) depth_m(x, y) = 1 + 2 * float(x) / 99;
    }
    DefocusJob job() const {
        DefocusJob job;
        job.colour = colour, job.depth_m = depth_m;
        job.place = Place::whole(colour.rect());
        job.camera = {.focal_length_mm = 85, .sensor_width_mm = 36, .f_number = 1.4, .focus_distance_m = 2};
        job.engine = "gaussian";
        job.gaussian.style = GaussianStyle::Wgld;
        return job;
    }
};

TEST(Gaussian, InFocusIsUntouched) {
    Shot shot = flat(70, 50, {}, 0);
    paint_noise(shot.colour, 1);
    for (const GaussianStyle style : kStyles)
        EXPECT_EQ(largest_difference(rendered(job_of(shot, style)), shot.colour), 0) << int(style);
}

TEST(Gaussian, AConstantPictureStaysConstantUpToTheBorder) {
    for (const GaussianStyle style : kStyles)
        for (const float coc : {-70.0f, -9.0f, 0.7f, 2.5f, 13.0f, 33.0f}) {
            Shot shot = flat(91, 61, {0.2f, 0.5f, 0.7f, 1}, coc);
            shot.coc_px(40, 30) = 2 * coc;
            EXPECT_LT(largest_difference(rendered(job_of(shot, style)), shot.colour), 5e-5)
                << coc << " style " << int(style);
        }
}

// Lines of light across a narrow picture, each elsewhere in the coarse cells that it is shared between.
class Lines {
public:
    static constexpr int kCount = 9;
    Lines(float coc, bool across)
        : coc_(coc), across_(across), radius_(int(std::abs(coc))), apart_(7 * radius_ + 13) {}
    // A shot of one blur, or between two blurs, beside a larger radius.
    Shot shot(bool mixed) const {
        const int length = (kCount + 2) * apart_;
        Shot shot = across_ ? flat(length, 2, {0, 0, 0, 1}, coc_) : flat(2, length, {0, 0, 0, 1}, coc_);
        for (int i = 0; i < kCount; ++i)
            for (int k = 0; k < 2; ++k)
                (across_ ? shot.colour(place(i), k) : shot.colour(k, place(i))) = {9, 9, 9, 1};
        if (mixed) shot.coc_px(0, 0) = 1.4f * coc_;
        return shot;
    }
    struct Seen {
        double light = 0, place = 0, moment = 0;
    };
    Seen seen(const Picture& image, int line) const {
        Seen sum;
        const int reach = 3 * radius_ + 6;
        for (int d = -reach; d <= reach; ++d) {
            const int at = place(line) + d;
            const double light = double((across_ ? image(at, 1) : image(1, at)).g) / 9;
            sum.light += light, sum.place += light * d, sum.moment += light * d * d;
        }
        return sum;
    }

private:
    int place(int line) const { return apart_ * (line + 1) + line * (radius_ / 7 + 1); }
    float coc_;
    bool across_;
    int radius_, apart_;
};

TEST(Gaussian, ALightIsAsWideAsItsDiscAndLiesWhereItIsOnEveryPlaceOfItsGrids) {
    for (const GaussianStyle style : {GaussianStyle::Layered, GaussianStyle::Plain})
        for (const float coc : {2.0f, -4.1f, 6.0f, 8.0f, -11.0f, 16.0f, 23.0f, 33.0f, -64.0f, 90.0f, 128.0f})
            for (const bool across : {true, false}) {
                const Lines lines(coc, across);
                const Shot shot = lines.shot(int(coc) % 2 != 0);
                const Picture image = rendered(job_of(shot, style));
                const double disc = double(coc) * double(coc) / 4 + 1.0 / 12;
                for (int i = 0; i < Lines::kCount; ++i) {
                    const Lines::Seen seen = lines.seen(image, i);
                    EXPECT_NEAR(seen.light, 1, 2e-3) << coc << " style " << int(style) << " line " << i;
                    EXPECT_NEAR(seen.place, 0, 0.1) << coc << " style " << int(style) << " line " << i;
                    EXPECT_NEAR(seen.moment, disc, 0.01 * disc) << coc << " style " << int(style) << " " << i;
                }
            }
}

// Stripes finer than the blur vanish, also where something else is blurred far more.
TEST(Gaussian, AMediumRadiusIsOneBlurAndNotASharpPictureUnderAFog) {
    for (const GaussianStyle style : {GaussianStyle::Layered, GaussianStyle::Plain}) {
        Shot shot = flat(160, 64, {}, 7);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 160; ++x) {
                const float c = x / 2 % 2 ? 0.8f : 0.2f;
                shot.colour(x, y) = {c, c, c, 1};
                if (x >= 120) shot.coc_px(x, y) = 40;
            }
        const Picture image = rendered(job_of(shot, style));
        for (int x = 24; x < 80; ++x) EXPECT_NEAR(image(x, 32).g, 0.5, 0.02) << x << " style " << int(style);
    }
}

TEST(Gaussian, WhatIsNearSpreadsOverWhatIsInFocus) {
    Shot shot = flat(128, 64, {0.8f, 0.8f, 0.8f, 1}, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = 64; x < 128; ++x) shot.colour(x, y) = {0, 0, 0, 1}, shot.coc_px(x, y) = -12;
    const Picture layered = rendered(job_of(shot, GaussianStyle::Layered));
    const Picture plain = rendered(job_of(shot, GaussianStyle::Plain));
    EXPECT_NEAR(layered(64, 32).g, 0.4, 0.05) << "half of each at the edge";
    EXPECT_NEAR(layered(60, 32).g, 0.8 * 0.75, 0.06) << "4 px = 0.67 sigma away";
    EXPECT_EQ(plain(60, 32).g, 0.8f) << "the published way keeps the edge hard";
}

// Pixels beside it hold a part of it; the stripes of the wall behind are in focus.
TEST(Gaussian, ABlurredWireLeavesNothingSharpAndTheWallGoesOnBehindIt) {
    constexpr double kWide = 3.6, kSigma = 6;
    const float wire = 0.02f;
    const auto wall = [](int y) { return y / 16 % 2 ? 0.6f : 0.3f; };
    Shot shot = flat(96, 64, {}, 0);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 96; ++x) {
            const bool inside = x >= 47 && x < 50, beside = x == 46 || x == 50;
            const float share = inside ? 1.0f : beside ? 0.3f : 0.0f, c = wall(y) + share * (wire - wall(y));
            shot.colour(x, y) = {c, c, c, 1};
            if (inside) shot.coc_px(x, y) = float(-2 * kSigma);
        }
    const Picture image = rendered(job_of(shot, GaussianStyle::Layered));
    for (const int y : {21, 24, 26, 37, 40, 42})
        for (int x = 20; x < 76; ++x) {
            const double away = (x - 48) / kSigma;
            const double covered = kWide / kSigma / std::sqrt(2 * M_PI) * std::exp(-away * away / 2);
            const double expected = double(wall(y)) + covered * double(wire - wall(y));
            EXPECT_NEAR(image(x, y).g, expected, 0.03) << x << ", " << y;
        }
}

TEST(Gaussian, PublishedWeightsAndIndexAreThoseOfTheFormula) {
    const DepthShot shot;
    DefocusJob job = shot.job();
    const auto view = [&](GaussianView v) {
        job.gaussian.view = v;
        return rendered(job);
    };
    for (const double offset : {0.0, 0.2, -0.3}) {
        job.gaussian.depth_offset = offset;
        const Picture index = view(GaussianView::FocusIndex), sharp = view(GaussianView::Sharp),
                      small = view(GaussianView::BlurSmall), large = view(GaussianView::BlurLarge),
                      result = view(GaussianView::Result);
        EXPECT_EQ(largest_difference(sharp, shot.colour), 0);
        for (int x = 0; x < 100; ++x) {
            const double at = std::clamp(double(x) / 99 + offset, 0.0, 1.0);
            const double d = at > 0.6 ? 2.5 * (1 - at) : at > 0.4 ? 1 : 2.5 * at;
            EXPECT_NEAR(index(x, 20).r, d, 1e-5) << x;
            const double mixed = d * double(sharp(x, 20).g) + d * (1 - d) * double(small(x, 20).g) +
                                 (1 - d) * (1 - d) * double(large(x, 20).g);
            EXPECT_NEAR(result(x, 20).g, mixed, 1e-5) << x;
        }
    }
}

// Depths outside the range too are moved by the offset before they are clamped, and misses are the farthest.
TEST(Gaussian, DepthIsClampedAfterTheOffsetIsAdded) {
    DepthShot shot;
    shot.depth_m(3, 20) = std::numeric_limits<float>::infinity();
    DefocusJob job = shot.job();
    job.gaussian.depth_near_m = 1.5, job.gaussian.depth_far_m = 2.5;
    job.gaussian.view = GaussianView::FocusIndex;
    for (const double offset : {-0.45, 0.3}) {
        job.gaussian.depth_offset = offset;
        const Picture index = rendered(job);
        for (int x = 4; x < 100; ++x) {
            const double at = std::clamp(2 * double(x) / 99 - 0.5 + offset, 0.0, 1.0);
            const double d = at > 0.6 ? 2.5 * (1 - at) : at > 0.4 ? 1 : 2.5 * at;
            EXPECT_NEAR(index(x, 20).r, d, 1e-5) << x << " offset " << offset;
        }
        EXPECT_EQ(index(3, 20).r, 0) << "offset " << offset;
    }
}

// The article's depth is the distance from the pinhole, which grows towards the corners of a wall.
TEST(Gaussian, DepthCountsAlongTheRayWhereThatIsAskedFor) {
    DepthShot shot;
    for (std::size_t i = 0; i < shot.depth_m.size(); ++i) shot.depth_m.pixels()[i] = 2;
    DefocusJob job = shot.job();
    job.camera.focal_length_mm = 20, job.camera.sensor_width_mm = 36;
    job.gaussian.depth_near_m = 1, job.gaussian.depth_far_m = 5, job.gaussian.depth_offset = 0;
    job.gaussian.view = GaussianView::FocusIndex;
    const Picture along_axis = rendered(job);
    job.gaussian.along_ray = true;
    const Picture along_ray = rendered(job);
    const double tan_per_px = 36.0 / 20 / shot.colour.width();
    for (const auto& [x, y] : {std::pair{0, 0}, {50, 20}, {99, 3}}) {
        const double right = (x + 0.5 - 0.5 * shot.colour.width()) * tan_per_px,
                     up = (y + 0.5 - 0.5 * shot.colour.height()) * tan_per_px;
        EXPECT_NEAR(along_axis(x, y).r, 2.5 * (2.0 - 1) / 4, 1e-5);
        EXPECT_NEAR(along_ray(x, y).r, std::min(1.0, 2.5 * (2 * std::hypot(1, right, up) - 1) / 4), 1e-5);
    }
}

TEST(Gaussian, TheFocusDistanceLiesInThePublishedBandUnlessAnOffsetIsGiven) {
    const DepthShot shot;
    DefocusJob job = shot.job();
    job.camera.focus_distance_m = 1.5;  // normalised 0.25: the band is 0.15…0.35
    job.gaussian.view = GaussianView::FocusIndex;
    const Picture index = rendered(job);
    EXPECT_EQ(index(25, 20).r, 1);
    EXPECT_EQ(index(33, 20).r, 1);
    EXPECT_LT(index(40, 20).r, 1);
    EXPECT_LT(index(10, 20).r, 1);
}

TEST(Gaussian, EveryBufferIsAnotherPicture) {
    const Shot shot = noise_at_several_depths();
    for (const GaussianStyle style : {GaussianStyle::Layered, GaussianStyle::Plain, GaussianStyle::Wgld}) {
        std::vector<Picture> seen;
        for (const GaussianView view :
             {GaussianView::Result, GaussianView::Sharp, GaussianView::BlurSmall, GaussianView::BlurLarge,
              GaussianView::BlurRows, GaussianView::FocusIndex}) {
            DefocusJob job = job_of(shot, style);
            job.gaussian.view = view;
            seen.push_back(rendered(job));
            for (std::size_t i = 0; i + 1 < seen.size(); ++i)
                EXPECT_GT(largest_difference(seen.back(), seen[i]), 1e-3)
                    << int(style) << " views " << i << ", " << int(view);
        }
    }
}

// Rows of one colour each are not changed by the first pass, columns of one colour not by the second.
TEST(Gaussian, BetweenTheTwoPassesRowsAreBlurredAndColumnsAreNot) {
    for (const float radius_px : {3.0f, 12.0f, 120.0f}) {
        Shot rows = flat(96, 64, {}, radius_px), columns = flat(96, 64, {}, radius_px);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x) {
                rows.colour(x, y) = {float(y % 7), float(y % 3), 1, 1};
                columns.colour(x, y) = {float(x % 23), float(x % 3), 1, 1};
            }
        const auto seen = [](const Shot& shot, GaussianView view) {
            DefocusJob job = job_of(shot, GaussianStyle::Wgld);
            job.gaussian.view = view;
            return rendered(job);
        };
        EXPECT_LT(largest_difference(seen(rows, GaussianView::BlurRows), rows.colour), 1e-5);
        EXPECT_GT(largest_difference(seen(rows, GaussianView::BlurLarge), rows.colour), 1);
        const Picture both = seen(columns, GaussianView::BlurLarge);
        EXPECT_LT(largest_difference(seen(columns, GaussianView::BlurRows), both), 1);
        EXPECT_GT(largest_difference(both, columns.colour), 5);
    }
}

TEST(Gaussian, TheSameBitsForAnyThreadCount) {
    const Shot shot = noise_at_several_depths();
    for (const GaussianStyle style : kStyles) {
        DefocusJob one = job_of(shot, style), two = job_of(shot, style);
        one.threads = 1, two.workers = &three_threads();
        EXPECT_EQ(largest_difference(rendered(one), rendered(two)), 0) << int(style);
    }
}

TEST(Gaussian, AwkwardPicturesStayFinite) {
    std::mt19937 random(9);
    for (const auto& [width, height] : {std::pair{1, 1}, {1, 17}, {17, 1}, {65, 3}, {257, 130}})
        for (const GaussianStyle style : kStyles)
            for (const float largest : {0.6f, 3.0f, 200.0f, 16000.0f}) {
                Shot shot = flat(width, height, {}, 0);
                paint_noise(shot.colour, 7);
                for (std::size_t i = 0; i < shot.coc_px.size(); ++i)
                    shot.coc_px.pixels()[i] = largest * (float(random() % 400) / 200 - 1);
                shot.colour(0, 0) = {-3, std::nanf(""), 1e30f, 1};
                shot.coc_px(width / 2, 0) = std::nanf("");
                DefocusJob job = job_of(shot, style);
                job.gaussian.focus_band = largest;
                for (int pass = 0; pass < 2; ++pass, job.gaussian.focus_band.reset()) {
                    const Picture image = rendered(job);
                    for (std::size_t i = 0; i < image.size(); ++i)
                        for (const float v : {image.pixels()[i].r, image.pixels()[i].g, image.pixels()[i].b,
                                              image.pixels()[i].a})
                            ASSERT_TRUE(std::isfinite(v))
                                << width << "x" << height << " style " << int(style);
                }
            }
}

}  // namespace
}  // namespace petzval::conformance
