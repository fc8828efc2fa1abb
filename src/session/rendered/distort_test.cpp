#include "session/rendered/distort.h"

#include "petzval/defocus.h"
#include "petzval/lens_kernel.h"

#include "base/parallel.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval {
namespace {

// Centre and variances of a picture's green light.
struct Blob {
    double light = 0, x = 0, y = 0, xx = 0, yy = 0;
};

Blob blob_of(const Picture& picture) {
    Blob b;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const double g = double(picture(x, y).g);
            b.light += g, b.x += g * (x + 0.5), b.y += g * (y + 0.5);
            b.xx += g * (x + 0.5) * (x + 0.5), b.yy += g * (y + 0.5) * (y + 0.5);
        }
    b.x /= b.light, b.y /= b.light;
    b.xx = b.xx / b.light - b.x * b.x, b.yy = b.yy / b.light - b.y * b.y;
    return b;
}

Place frame_of(int width, int height) { return Place::whole({0, 0, width, height}); }

Picture distorted(const Picture& picture, double amount, const Place& place,
                  Workers& workers = one_thread()) {
    return distorted(picture, picture.rect(), place, amount, workers);
}

TEST(Distorted, WithoutDistortionItIsThePicture) {
    Picture picture(40, 30);
    for (std::size_t i = 0; i < picture.size(); ++i)
        picture.pixels()[i] = {float(i % 7), float(i % 11), float(i % 5), 1};
    const Picture same = distorted(picture, 0, frame_of(40, 30));
    for (std::size_t i = 0; i < picture.size(); ++i)
        EXPECT_LT(std::abs(same.pixels()[i].g - picture.pixels()[i].g), 1e-5f);
}

TEST(Distorted, APointMovesByTheCubeOfItsRadius) {
    for (const double amount : {0.08, -0.08}) {
        Picture picture(400, 300, Rgba{0, 0, 0, 1});
        for (int y = 198; y < 203; ++y)
            for (int x = 298; x < 303; ++x) picture(x, y).g = 1;
        const Place place = frame_of(400, 300);
        const double right = 300.5 - 200, down = 200.5 - 150,
                     r = place.field().field_per_px * std::hypot(right, down);
        const Blob blob = blob_of(distorted(picture, amount, place, *own_workers(2)));
        // The square is not a point: its far side moves more.
        EXPECT_NEAR(blob.x, 200 + right * (1 + amount * r * r), 0.15);
        EXPECT_NEAR(blob.y, 150 + down * (1 + amount * r * r), 0.15);
    }
}

TEST(Distorted, NothingGrowsBrighterOrDarkerThanWhatIsThere) {
    Picture picture(64, 64, Rgba{0, 0, 0, 1});
    picture(40, 20) = {1000, 1000, 1000, 1};
    const Picture moved = distorted(picture, 0.2, frame_of(64, 64));
    for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_GE(moved.pixels()[i].g, 0);
        EXPECT_LE(moved.pixels()[i].g, 1000);
        EXPECT_EQ(moved.pixels()[i].a, 1);
    }
}

// A lamp in the outermost column.
Picture lamp_at_the_edge() {
    Picture picture(200, 120, Rgba{0.1f, 0.1f, 0.1f, 1});
    for (int y = 58; y < 62; ++y)
        for (int x = 196; x < 200; ++x) picture(x, y) = {50, 50, 50, 1};
    return picture;
}

TEST(Distorted, ALampAtTheEdgeIsDrawnOutToNoBar) {
    const Picture moved = distorted(lamp_at_the_edge(), -0.1, frame_of(200, 120));
    // Its mirror image doubles it, and the lens makes it smaller; earlier it continued to the frame's edge.
    int wide = 0;
    for (int x = 0; x < 200; ++x) wide += moved(x, 60).g > 25;
    EXPECT_GE(wide, 4);
    EXPECT_LE(wide, 9);
}

TEST(Distorted, AroundAPictureThatEndsInsideOfTheFrameThereIsNothing) {
    Place place = frame_of(200, 120);
    place.display_window = {0, 0, 260, 120};  // the picture ends at column 200
    Picture moved = distorted(lamp_at_the_edge(), -0.1, place);
    double right_of_lamp = 0;
    for (int y = 0; y < 120; ++y) right_of_lamp += double(moved(199, y).g) + double(moved(199, y).a);
    EXPECT_EQ(right_of_lamp, 0);
    EXPECT_EQ(missing_beyond_px(place, -0.1), missing_beyond_px(frame_of(260, 120), -0.1));
}

TEST(Distorted, OverscanTakesThePlaceOfTheMirrorImage) {
    const Place bare = frame_of(200, 120);
    const int reach = distortion_reach_px(bare, -0.1);
    EXPECT_GE(reach, missing_beyond_px(bare, -0.1));
    EXPECT_GT(missing_beyond_px(bare, -0.1), 5);
    EXPECT_EQ(missing_beyond_px(bare.grown(reach), -0.1), 0);
    EXPECT_EQ(missing_beyond_px(bare, 0.1), 0);
    // Worked out by hand: r (1 - 0.1 r^2) = 1 at r = 1.1535, and the half diagonal is 116.6 px.
    EXPECT_EQ(reach, 18);
}

TEST(Distorted, WhereStrongBarrelDistortionShowsNothingThePictureIsEmpty) {
    Picture picture(100, 100, Rgba{1, 1, 1, 1});
    const Picture moved = distorted(picture, -0.3, frame_of(100, 100));
    EXPECT_EQ(moved(0, 0), Rgba{});
    EXPECT_EQ(moved(50, 50), (Rgba{1, 1, 1, 1}));
    EXPECT_EQ(moved(1, 50).a, 1);  // 2/3 of sqrt(1/0.9) is 0.703 half diagonals, 49.7 px
}

// A picture's disc is the kernel of the lens with that distortion, where the lens puts it.
TEST(Distorted, DiscsOfAPictureHaveTheShapeOfTheKernel) {
    constexpr int kWidth = 480, kHeight = 320;
    Picture colour(kWidth, kHeight, Rgba{0, 0, 0, 1});
    colour(400, 160) = {1000, 1000, 1000, 1};
    Plane coc(kWidth, kHeight, 14.0f);
    DefocusJob job;
    job.colour = colour, job.coc_px = coc;
    job.place = Place::whole(colour.rect());
    job.camera = {50, 36, 2, 2};
    job.lens.distortion = 0.15;
    const auto report = defocus(job);
    ASSERT_TRUE(report) << report.error().message;
    const Blob disc = blob_of(report->image);

    const double right = 400.5 - 240, r = right * 2 / std::hypot(kWidth, kHeight);
    const double moved = right * (1 + 0.15 * r * r);
    EXPECT_NEAR(disc.x, 240 + moved,
                0.1 + 0.01 * right);  // a disc is pushed out a little more than its middle
    const auto kernel = lens_point_spread(job.lens, {job.camera, kWidth, kHeight, 1}, 14, r, 0);
    ASSERT_TRUE(kernel);
    const Blob expected = blob_of(kernel->weights);
    EXPECT_NEAR(disc.xx, expected.xx, 0.04 * expected.xx);
    EXPECT_NEAR(disc.yy, expected.yy, 0.04 * expected.yy);
    EXPECT_GT(disc.xx, 1.1 * disc.yy);
}

TEST(Distorted, APrescriptionRefusesIt) {
    Picture colour(16, 16);
    Plane coc(16, 16, 1.0f);
    DefocusJob job;
    job.colour = colour, job.coc_px = coc;
    job.place = Place::whole(colour.rect());
    job.camera = {50, 36, 4, 2};
    job.lens.name = "tessar", job.lens.distortion = 0.1;
    const auto report = defocus(job);
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().message.find("lens.distortion"), std::string::npos);
}

}  // namespace
}  // namespace petzval
