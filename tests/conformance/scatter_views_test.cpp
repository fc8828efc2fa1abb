// --view layers, hidden, guessed and highlights: what scatter takes a scene for.
#include "shots.h"

namespace petzval::conformance {
namespace {

DefocusReport view_of(const Shot& shot, ScatterView view) {
    DefocusJob job = shot.job("scatter");
    job.scatter.view = view;
    auto report = defocus(job);
    EXPECT_TRUE(report);
    return std::move(*report);
}

Picture panel(const DefocusReport& report, std::size_t i) {
    const View<const Rgba> part = report.image.view().part(report.panels.at(i).area);
    Picture copy(part.width(), part.height());
    for (int y = 0; y < part.height(); ++y) std::copy_n(part.row(y), part.width(), copy.view().row(y));
    return copy;
}

constexpr Rgba kRed{0.6f, 0.1f, 0.1f, 1}, kBlue{0.1f, 0.2f, 0.6f, 1};

// A red square 9 px in front of focus before blue 5 px behind it.
Shot a_square() {
    Shot shot = flat(96, 64, kBlue, 5);
    for (int y = 20; y < 44; ++y)
        for (int x = 30; x < 60; ++x) shot.colour(x, y) = kRed, shot.coc_px(x, y) = -9;
    return shot;
}

TEST(Layers, ShowWhatIsSeenAndWhatWasFoundBehindIt) {
    const DefocusReport report = view_of(a_square(), ScatterView::Layers);
    ASSERT_EQ(report.panels.size(), 4U);  // a second surface, but no third
    const Picture nearest = panel(report, 0), second = panel(report, 2);
    EXPECT_EQ(nearest(10, 10), kBlue);
    EXPECT_EQ(nearest(33, 23), kRed);
    EXPECT_EQ(second(10, 10), Rgba{});
    EXPECT_NEAR(second(33, 23).b, kBlue.b, 1e-4);
    EXPECT_NEAR(second(33, 23).a, 1, 1e-4);
}

TEST(Layers, AreNumberedFromFocusNegativeInFront) {
    const DefocusReport report = view_of(a_square(), ScatterView::Layers);
    const Picture nearest = panel(report, 1), second = panel(report, 3);
    EXPECT_TRUE(report.panels[1].is_numbers && report.panels[3].is_numbers);
    EXPECT_EQ(nearest(10, 10).r, 5);
    EXPECT_LT(nearest(33, 23).r, -8);
    EXPECT_EQ(second(33, 23).r, 5);
    EXPECT_TRUE(std::isnan(second(10, 10).r));
}

TEST(Layers, OfAPictureThatKnowsWhatIsHiddenAreThose) {
    Shot shot = a_square();
    put_behind(
        shot,
        [](int, int) {
            return Rgba{0.2f, 0.5f, 0.1f, 1};
        },
        [](int, int) { return 12.0f; });
    const DefocusReport report = view_of(shot, ScatterView::Layers);
    EXPECT_EQ(panel(report, 2)(10, 10), (Rgba{0.2f, 0.5f, 0.1f, 1}));
    // The surroundings of the square continue behind it, in front of the known background.
    EXPECT_NEAR(panel(report, 2)(33, 23).b, kBlue.b, 1e-4);
    EXPECT_EQ(panel(report, 4)(33, 23), (Rgba{0.2f, 0.5f, 0.1f, 1}));
}

// A card before a wall, both textured; the same camera for all.
struct CardInMetres {
    Picture colour{96, 64, kBlue};
    Plane depth_m{96, 64, 5};
    CardInMetres() {
        paint_noise(colour, 3);
        for (int y = 20; y < 44; ++y)
            for (int x = 30; x < 60; ++x) colour(x, y) = kRed, depth_m(x, y) = 2;
        for (int y = 20; y < 44; ++y) colour(60, y) = 0.5f * (kRed + kBlue);  // half the card's
    }
    DefocusJob job() const {
        DefocusJob job;
        job.colour = colour, job.depth_m = depth_m;
        job.place = Place::whole(colour.rect());
        job.camera = {85, 10, 1.4, 3};  // radii of -4 and 3 px
        return job;
    }
};

TEST(Hidden, SurfacesComeAsDeepSamplesInMetresThatFlattenToThePicture) {
    CardInMetres card;
    card.colour(61, 30) = {40, 20, 5, 1}, card.colour(60, 30) = {20, 10, 2.5f, 1};  // a lamp at the edge
    DefocusJob job = card.job();
    job.scatter.view = ScatterView::Hidden;
    const auto report = defocus(job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->panels.empty());
    const auto inside = report->hidden.at(32, 22);
    ASSERT_EQ(inside.size(), 2U);
    EXPECT_NEAR(inside[0].depth, 2, 1e-4);
    EXPECT_NEAR(inside[1].depth, 5, 1e-3);
    EXPECT_EQ(inside[0].colour, kRed);
    EXPECT_GT(inside[1].colour.a, 0.99f);
    EXPECT_EQ(report->hidden.at(5, 5).size(), 1U);
    Picture flat;
    Plane depth_m;
    flatten(report->hidden, flat, depth_m);
    double largest = 0;
    for (std::size_t i = 0; i < flat.size(); ++i)
        largest = std::max(largest, std::abs(double(flat.pixels()[i].r - card.colour.pixels()[i].r)));
    EXPECT_LT(largest, 1e-3);
}

TEST(Hidden, SurfacesGivenBackAreThePicturesOwn) {
    const CardInMetres card;
    DefocusJob job = card.job();
    const Picture expected = rendered(job);
    job.scatter.view = ScatterView::Hidden;
    const auto report = defocus(job);
    ASSERT_TRUE(report);
    job.scatter.view = ScatterView::Result;
    job.behind = &report->hidden;
    // Given hidden layers are composited through more sectors of the pupil than estimated ones.
    EXPECT_LT(largest_difference(rendered(job), expected), 0.025);
}

TEST(Hidden, SurfacesOfRadiiThatWereChangedAreRefused) {
    const CardInMetres card;
    DefocusJob job = card.job();
    job.scatter.view = ScatterView::Hidden, job.coc.near_scale = 0.5;
    EXPECT_FALSE(defocus(job));
}

TEST(Guessed, LightThatComesPastANearEdgeIsMarkedAndNothingElse) {
    const Picture matte = view_of(a_square(), ScatterView::Guessed).image;
    EXPECT_EQ(matte(5, 5), (Rgba{0, 0, 0, 1}));  // farther from the square than any blur reaches
    EXPECT_LT(matte(45, 32).r, 0.01f);           // the square fills the lens
    EXPECT_GT(matte(31, 32).r, 0.2f);
    EXPECT_GT(matte(31, 32).r, matte(35, 32).r);
    for (std::size_t i = 0; i < matte.size(); ++i) {
        const Rgba c = matte.pixels()[i];
        ASSERT_TRUE(c.r >= 0 && c.r <= 1 && c.g == c.r && c.b == c.r && c.a == 1);
    }
}

TEST(Guessed, OnePlainSurfaceHasNoGuess) {
    Shot shot = flat(96, 64, kBlue, 5);
    paint_noise(shot.colour, 3);
    const Picture matte = view_of(shot, ScatterView::Guessed).image;
    EXPECT_EQ(largest_difference(matte, Picture(96, 64, Rgba{0, 0, 0, 1})), 0);
}

TEST(Guessed, NothingIsMarkedWhereACleanPlateShowsIt) {
    Shot shot = a_square();
    put_behind(
        shot, [](int, int) { return kBlue; }, [](int, int) { return 5.0f; });
    const Picture matte = view_of(shot, ScatterView::Guessed).image;
    EXPECT_EQ(largest_difference(matte, Picture(96, 64, Rgba{0, 0, 0, 1})), 0);
}

TEST(Guessed, WhatAPlateLeavesOutIsMarked) {
    const Picture without = view_of(a_square(), ScatterView::Guessed).image;
    // A crop is completed as a separate picture, whose surfaces are composited through more sectors of the
    // pupil than those of a patch. A column of one pixel makes a patch of the crop.
    for (const bool is_crop : {false, true}) {
        Shot shot = a_square();
        shot.behind = DeepPicture::made_of(96, 64, [&](int x, int y, std::vector<DeepSample>& samples) {
            if (y < 20 || (!is_crop && x == 0)) samples.push_back({kBlue, 5, 5});
        });
        const Picture matte = view_of(shot, ScatterView::Guessed).image;
        for (int x = 0; x < 96; ++x) {
            EXPECT_NEAR(matte(x, 44).r, without(x, 44).r, is_crop ? 0.05f : 0.01f) << x;
            EXPECT_LT(matte(x, 16).r, 0.1f) << x;
        }
    }
}

// A renderer's deep file ends each pixel at its first opaque sample.
TEST(Guessed, WhatADeepPixelDoesNotStateIsMarked) {
    const Shot shot = a_square();
    const Picture flat = view_of(shot, ScatterView::Guessed).image;
    const DeepPicture deep =
        DeepPicture::made_of(96, 64, [&](int x, int y, std::vector<DeepSample>& samples) {
            samples.push_back({shot.colour(x, y), shot.coc_px(x, y), shot.coc_px(x, y)});
        });
    DefocusJob job = shot.job("scatter");
    job.deep = &deep, job.scatter.view = ScatterView::Guessed;
    const auto report = defocus(job);
    ASSERT_TRUE(report);
    EXPECT_LT(largest_difference(report->image, flat), 0.1);
    EXPECT_GT(report->image(31, 32).r, 0.2f);
}

TEST(Guessed, NothingIsMarkedWithoutFill) {
    const Picture full = view_of(a_square(), ScatterView::Guessed).image;
    Shot off = a_square();
    DefocusJob job = off.job("scatter");
    job.scatter.view = ScatterView::Guessed, job.fill = Fill::Off;
    const auto none = defocus(job);
    ASSERT_TRUE(none);
    EXPECT_LT(none->image(31, 32).r, 0.01f);  // nothing was guessed
    EXPECT_GT(full(31, 32).r, 0.2f);
}

TEST(Layers, BeyondTheFourthAreSaidNotToBeShown) {
    Shot shot = flat(16, 16, kBlue, 0);
    shot.behind = DeepPicture::made_of(16, 16, [](int, int, std::vector<DeepSample>& samples) {
        for (int k = 1; k <= 5; ++k) samples.push_back({kRed, float(3 * k), float(3 * k)});
    });
    const DefocusReport report = view_of(shot, ScatterView::Layers);
    EXPECT_EQ(report.panels.size(), 8U);
    ASSERT_EQ(report.warnings.size(), 1U);
    EXPECT_NE(report.warnings[0].find("up to 6"), std::string::npos);
}

TEST(Highlights, AreNotTakenWhereNoRayMeetsThem) {
    // Lamps all over behind a wall that fills the frame, which would each be drawn with their shadow.
    Shot shot = flat(64, 64, {0.1f, 0.1f, 0.1f, 1}, 2);
    put_behind(
        shot,
        [](int, int) {
            return Rgba{50, 50, 50, 1};
        },
        [](int, int) { return 7.0f; });
    const Picture taken = panel(view_of(shot, ScatterView::Highlights), 1);
    EXPECT_EQ(taken(32, 32), Rgba{});
    const Picture image = rendered(shot.job("scatter"));
    for (int y = 10; y < 54; ++y)
        for (int x = 10; x < 54; ++x) EXPECT_NEAR(image(x, y).g, 0.1, 1e-3) << x << ", " << y;
}

TEST(Highlights, HoldTheLightTakenFromThePicture) {
    for (const float coc : {0.0f, -9.0f, 20.0f}) {
        Shot shot = flat(160, 120, {0.2f, 0.2f, 0.2f, 1}, coc);
        shot.colour(80, 60) = {90, 60, 30, 1};
        const DefocusReport report = view_of(shot, ScatterView::Highlights);
        const Picture drawn = panel(report, 0), taken = panel(report, 1);
        EXPECT_GT(taken(80, 60).r, 80);
        EXPECT_EQ(taken(80, 60).a, 1);
        EXPECT_EQ(taken(79, 60), Rgba{});
        double sent = 0, arrived = 0;
        for (std::size_t i = 0; i < drawn.size(); ++i)
            sent += double(taken.pixels()[i].g), arrived += double(drawn.pixels()[i].g);
        EXPECT_NEAR(arrived, sent, 1e-3 * sent) << coc;
    }
}

TEST(Highlights, AndTheRestAreTheResult) {
    Shot shot = flat(160, 120, {0.2f, 0.2f, 0.2f, 1}, 12);
    shot.colour(80, 60) = {900, 900, 900, 1};
    const Picture drawn = panel(view_of(shot, ScatterView::Highlights), 0);
    const Picture result = rendered(shot.job("scatter"));
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x)
            EXPECT_NEAR(result(x, y).g - drawn(x, y).g, 0.2, 0.01) << x << ", " << y;
    EXPECT_GT(result(80, 60).g, 1.5f);
}

TEST(Highlights, AreNoneWhereNothingStandsOut) {
    const DefocusReport report = view_of(flat(64, 48, kBlue, 7), ScatterView::Highlights);
    for (std::size_t i = 0; i < report.image.size(); ++i) EXPECT_EQ(report.image.pixels()[i], Rgba{});
}

}  // namespace
}  // namespace petzval::conformance
