// A mask limits the effect: 1 as blurred, 0 as given, between them mixed, whatever else is chosen.
#include "petzval/session.h"

#include <string>

#include <gtest/gtest.h>

namespace petzval {
namespace {

struct Shot {
    Picture colour{48, 32, {0.2f, 0.1f, 0.05f, 1}}, key{48, 32, {0.1f, 0.05f, 0, 1}};
    Plane coc_px{48, 32, 5.0f}, mask{48, 32, 1.0f};
    DefocusJob job;

    Shot() {
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 48; ++x) {
                colour(x, y) += Rgba{0.01f * float((x * 7 + y * 3) % 11), 0, 0, 0};
                mask(x, y) = x < 16 ? 0.0f : x < 32 ? 0.25f : 1.0f;
            }
        colour(20, 16) = {40, 30, 20, 1};
        key(20, 16) = {10, 30, 0, 1};
        job.colour = colour, job.coc_px = coc_px;
        job.place = Place::whole(colour.rect());
        job.layers = {{key}};
    }
};

void expect_mixed(const Picture& limited, const Picture& blurred, const Picture& sharp, int x0 = 0) {
    for (int y = 0; y < limited.height(); ++y)
        for (int x = 0; x < limited.width(); ++x) {
            const int column = x + x0;
            const Rgba b = blurred(x, y), s = sharp(column, y), l = limited(x, y);
            SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
            if (column >= 16 && column < 32) {
                ASSERT_NEAR(l.g, 0.75f * s.g + 0.25f * b.g, 1e-5);
            } else {
                ASSERT_EQ(l, column < 16 ? s : b);
            }
        }
}

TEST(Mask, LimitsPictureAndLayersExactly) {
    const Shot shot;
    for (const char* engine : {"scatter", "gather", "gaussian"}) {
        DefocusJob job = shot.job;
        job.engine = engine;
        const auto blurred = defocus(job);
        job.mask = shot.mask;
        const auto limited = defocus(job);
        ASSERT_TRUE(blurred && limited) << limited.error().message;
        expect_mixed(limited->image, blurred->image, shot.colour);
        expect_mixed(limited->layers[0], blurred->layers[0], shot.key);
    }
}

TEST(Mask, LimitsAllThatALookDoesToLight) {
    const Shot shot;
    Look look;
    look.glare.bloom = 0.2, look.vignetting = true;
    DefocusJob job = shot.job;
    job.camera = {.focal_length_mm = 20, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 2};
    Session session;
    const auto blurred = session.take(job, look);
    job.mask = shot.mask;
    const auto limited = session.take(job, look);
    ASSERT_TRUE(blurred && limited) << limited.error().message;
    expect_mixed(limited->image, blurred->image, shot.colour);
    const auto part = session.take(job, look, {.region = Rect{10, 4, 40, 20}});
    ASSERT_TRUE(part);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 30; ++x) ASSERT_EQ(part->image(x, y), limited->image(x + 10, y + 4));
}

TEST(Mask, OfAnotherSizeIsRefused) {
    const Shot shot;
    const Plane small(20, 20, 1.0f);
    DefocusJob job = shot.job;
    job.mask = small;
    const auto refused = defocus(job);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("mask"), std::string::npos);
}

}  // namespace
}  // namespace petzval
