// A result in the memory of the picture that it is made of is the same result.
#include "petzval/session.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 150, kHeight = 90;

Picture textured() {
    Picture colour(kWidth, kHeight, {0.2f, 0.1f, 0.05f, 1});
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) colour(x, y) += Rgba{0.01f * float((x * 7 + y * 3) % 11), 0, 0, 0};
    colour(70, 40) = {40, 30, 20, 1};
    return colour;
}

// A near disc over the background.
Plane radii() {
    Plane coc_px(kWidth, kHeight, 4.0f);
    for (int y = 20; y < 60; ++y)
        for (int x = 30; x < 65; ++x) coc_px(x, y) = -6;
    return coc_px;
}

DefocusJob job_of(const Picture& colour, const Plane& coc_px) {
    DefocusJob job;
    job.colour = colour, job.coc_px = coc_px;
    job.place = Place::whole(colour.rect());
    return job;
}

bool equal(const Picture& a, const Picture& b) {
    return a.rect() == b.rect() && std::equal(a.pixels(), a.pixels() + a.size(), b.pixels());
}

TEST(SpentColour, HoldsTheSameResult) {
    const Plane coc_px = radii();
    for (const std::string engine : {"scatter", "gather", "gaussian", "sprites"}) {
        Picture colour = textured();
        DefocusJob job = job_of(colour, coc_px);
        job.engine = engine;
        const auto apart = defocus(job);
        const Rgba* const memory = colour.pixels();
        job.spent_colour = &colour;
        const auto within = defocus(job);
        ASSERT_TRUE(apart && within) << engine;
        EXPECT_TRUE(equal(apart->image, within->image)) << engine;
        if (engine == "scatter") {
            EXPECT_EQ(within->image.pixels(), memory);
        }
    }
}

TEST(SpentColour, IsKeptWhereAMaskOrALayerAsksForIt) {
    const Plane coc_px = radii(), mask(kWidth, kHeight, 0.5f);
    const Picture key = textured();
    Picture colour = textured();
    DefocusJob masked = job_of(colour, coc_px), layered = masked;
    masked.mask = mask, layered.layers = {{key}};
    for (DefocusJob job : {masked, layered}) {
        const auto apart = defocus(job);
        job.spent_colour = &colour;
        const auto within = defocus(job);
        ASSERT_TRUE(apart && within);
        EXPECT_TRUE(equal(apart->image, within->image));
        EXPECT_TRUE(equal(colour, key));
    }
}

}  // namespace
}  // namespace petzval
