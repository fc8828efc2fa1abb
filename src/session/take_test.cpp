#include "petzval/dynamic_range.h"
#include "petzval/frame_stages.h"
#include "petzval/glare.h"
#include "petzval/session.h"

#include "kernel/lenses/opened_lens.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 64, kHeight = 48;

// A lamp on grey, five pixels out of focus.
struct Rendered {
    Picture colour{kWidth, kHeight, {0.2f, 0.2f, 0.2f, 1}};
    Plane radii{kWidth, kHeight, 5};
    DefocusJob job;
    Rendered() {
        colour(20, 20) = {1, 0.9f, 0.8f, 1};
        job.colour = colour;
        job.coc_px = radii;
        job.place = Place::whole(colour.rect());
        job.camera = {50, 36, 2, 3};
    }
};

bool same(const Picture& a, const Picture& b) {
    return a.size() == b.size() && std::equal(a.pixels(), a.pixels() + a.size(), b.pixels());
}

TEST(Take, ALookWithoutLightIsADefocus) {
    const Rendered r;
    Session session;
    const auto taken = session.take(r.job, {}), defocused = session.defocus(r.job);
    ASSERT_TRUE(taken && defocused);
    EXPECT_TRUE(same(taken->image, defocused->image));
}

// A near square before a wall, its radii blurred as a network's are.
struct SoftlyRendered : Rendered {
    SoftlyRendered() {
        Plane exact(kWidth, kHeight, 0);
        for (int y = 12; y < 36; ++y)
            for (int x = 16; x < 44; ++x) exact(x, y) = -8, colour(x, y) = {0.6f, 0.1f, 0.1f, 1};
        const float weights[]{0.06f, 0.24f, 0.4f, 0.24f, 0.06f};
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                radii(x, y) = 0;
                for (int v = -2; v <= 2; ++v)
                    for (int u = -2; u <= 2; ++u)
                        radii(x, y) += weights[u + 2] * weights[v + 2] * exact.view().clamped(x + u, y + v);
            }
    }
};

TEST(Take, SoftSilhouettesOfDepthAreSnappedAndSaidToBe) {
    const SoftlyRendered r;
    Session session;
    Look look;
    const auto by_itself = session.take(r.job, look);
    look.depth_edges = DepthEdges::Snap;
    const auto snapped = session.take(r.job, look);
    look.depth_edges = DepthEdges::Keep;
    const auto kept = session.take(r.job, look);
    ASSERT_TRUE(by_itself && snapped && kept);
    EXPECT_TRUE(same(by_itself->image, snapped->image));
    EXPECT_FALSE(same(by_itself->image, kept->image));
    ASSERT_EQ(by_itself->warnings.size(), kept->warnings.size() + 1);
    EXPECT_NE(by_itself->warnings.back().find("depth.edges"), std::string::npos);
    const auto radii = circle_of_confusion(r.job);
    ASSERT_TRUE(radii);
    for (std::size_t i = 0; i < radii->size(); ++i)
        EXPECT_TRUE(radii->pixels()[i] < -7 || radii->pixels()[i] > -1) << i;
}

TEST(Take, SilhouettesOfRenderersStayAsTheyAre) {
    SoftlyRendered r;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) r.radii(x, y) = r.radii(x, y) < -4 ? -8.0f : 0.1f * float(x);
    Session session;
    Look keep;
    keep.depth_edges = DepthEdges::Keep;
    const auto by_itself = session.take(r.job, {}), kept = session.take(r.job, keep);
    ASSERT_TRUE(by_itself && kept);
    EXPECT_TRUE(same(by_itself->image, kept->image));
    EXPECT_EQ(by_itself->warnings, kept->warnings);
}

TEST(Take, CornersDarkenBeforeGlareAddsItsLight) {
    const Rendered r;
    Session session;
    Look look;
    look.vignetting = true;
    look.glare.bloom = 0.3;
    const auto taken = session.take(r.job, look), blurred = session.defocus(r.job);
    ASSERT_TRUE(taken && blurred);
    const auto dimmed = add_falloff(blurred->image, {.camera = r.job.camera});
    ASSERT_TRUE(dimmed);
    GlareSettings glare;
    static_cast<GlareAmounts&>(glare) = look.glare;
    glare.camera = r.job.camera;
    glare.diffraction_px = 550e-6 * 2 * kWidth / 36;
    const auto expected = add_glare(*dimmed, glare);
    ASSERT_TRUE(expected);
    EXPECT_TRUE(same(taken->image, *expected));
}

TEST(Take, LightCanBeAddedToAPictureThatWasBlurredBefore) {
    const Rendered r;
    Session session;
    Look look;
    look.vignetting = true, look.glare.veil = 0.1, look.glare.bloom = 0.2;
    const auto taken = session.take(r.job, look);
    auto frame = FrameStages::begin(session, *rendered_of(r.job), look);
    ASSERT_TRUE(taken && frame && frame->blur());
    auto defocused = std::move(*frame).report();
    ASSERT_TRUE(defocused);
    const auto light = add_light(std::move(defocused->image), r.job, look);
    ASSERT_TRUE(light) << light.error().message;
    EXPECT_TRUE(same(taken->image, *light));
    EXPECT_EQ(taken->stages.back().stage, "light");
    look.glare.veil = 2;
    EXPECT_FALSE(add_light({}, r.job, look));
}

TEST(Take, APlateIsBlurredWithItsHighlightsAndComesBackToItsRange) {
    const Rendered r;
    Session session;
    Look look;
    look.expand_highlights = true;
    const auto taken = session.take(r.job, look), plain = session.take(r.job, {});
    ASSERT_TRUE(taken && plain);
    EXPECT_GT(taken->image(18, 20).r, plain->image(18, 20).r);  // within the lamp's disc
    for (std::size_t i = 0; i < taken->image.size(); ++i) EXPECT_LE(taken->image.pixels()[i].r, 1);
}

TEST(Take, AStarIsKeptFromFrameToFrameAndLightsThemAlike) {
    Rendered r;
    r.job.camera.f_number = 200;  // a coarse grain, which is made at once
    Look look;
    look.lens.aperture.blades = 6, look.glare.star = 0.5, look.glare.threshold = 0;
    Session session;
    const auto first = session.take(r.job, look);
    const std::size_t kept = session.usage().kept_bytes;
    const auto again = session.take(r.job, look), alone = Session().take(r.job, look);
    ASSERT_TRUE(first && again && alone);
    EXPECT_TRUE(same(first->image, again->image));
    EXPECT_TRUE(same(again->image, alone->image));
    EXPECT_EQ(session.usage().kept_bytes, kept);
    look.glare.star_radius = 0.25;
    ASSERT_TRUE(session.take(r.job, look));
    EXPECT_GT(session.usage().kept_bytes, kept);
    session.trim(0);
    EXPECT_EQ(session.usage().kept_bytes, 0u);
}

TEST(Take, SurfacesOfAPictureAreKeptWhileItsLensChanges) {
    Rendered r;
    for (int y = 12; y < 36; ++y)
        for (int x = 24; x < 44; ++x) r.radii(x, y) = -8, r.colour(x, y) = {0.6f, 0.1f, 0.1f, 1};
    for (const char* engine : {"scatter", "gather", "gaussian"}) {
        Session session;
        std::size_t kept = 0;
        for (const int blades : {0, 5, 6, 7}) {
            Look look;
            look.engine = engine, look.lens.aperture.blades = blades;
            const auto taken = session.take(r.job, look), alone = Session().take(r.job, look);
            ASSERT_TRUE(taken && alone);
            EXPECT_TRUE(same(taken->image, alone->image)) << engine << ", blades: " << blades;
            kept = session.usage().kept_bytes;
        }
        // Another picture of the same size has other surfaces.
        Rendered other;
        for (int y = 12; y < 36; ++y)
            for (int x = 4; x < 24; ++x) other.radii(x, y) = -8, other.colour(x, y) = {0.1f, 0.6f, 0.1f, 1};
        const auto taken = session.take(other.job, {}), alone = Session().take(other.job, {});
        ASSERT_TRUE(taken && alone);
        EXPECT_TRUE(same(taken->image, alone->image)) << engine;
        session.trim(0);
        EXPECT_GT(kept, 0u);
        EXPECT_EQ(session.usage().kept_bytes, 0u);
    }
}

TEST(Take, RaysOfAnOpenedLensCountAsKeptAndAreGivenBack) {
    Rendered r;
    LensChoice choice;
    choice.name = "double-gauss";
    const Lens lens = Lens::open(choice).value();
    r.job.opened_lens = lens, r.job.camera.f_number = 2.8;
    Look look;
    look.lens = choice;
    Session session;
    kernel::LastRays& rays = *lens.contents().last_rays;
    for (const double focus_m : {2.0, 3.0}) {
        const std::size_t before = rays.bytes(), kept = session.usage().kept_bytes;
        r.job.camera.focus_distance_m = focus_m;
        const auto taken = session.take(r.job, look);
        ASSERT_TRUE(taken) << taken.error().message;
        EXPECT_GT(rays.bytes(), before);
        EXPECT_GE(session.usage().kept_bytes, kept + rays.bytes() - before);
    }
    const std::size_t all = rays.bytes(), kept = session.usage().kept_bytes;
    session.trim(kept - 1);
    EXPECT_LT(rays.bytes(), all);
    EXPECT_GT(rays.bytes(), 0u);
    EXPECT_LT(session.usage().kept_bytes, kept);
    session.trim(0);
    EXPECT_EQ(rays.bytes(), 0u);
    EXPECT_EQ(session.usage().kept_bytes, 0u);
}

TEST(Take, SaysWhatItCannotTake) {
    const Rendered r;
    Session session;
    Look look;
    look.engine = "brush";
    const auto taken = session.take(r.job, look);
    ASSERT_FALSE(taken);
    EXPECT_NE(taken.error().message.find("brush"), std::string::npos);
}

TEST(Take, RefusesADataWindowOfAnotherSize) {
    Rendered r;
    Session session;
    for (const int width : {kWidth - 1, kWidth + 1, 100 * kWidth}) {
        r.job.place.data_window = {0, 0, width, kHeight};
        const auto taken = session.take(r.job, {});
        ASSERT_FALSE(taken) << width;
        EXPECT_NE(taken.error().message.find("data_window"), std::string::npos);
    }
}

TEST(Take, ListsChoicesWithoutEffectAndRefusesContradictions) {
    const Rendered r;
    Session session;
    Look look;
    look.engine = "gaussian";
    look.lens.aperture.blades = 5;
    const auto taken = session.take(r.job, look);
    ASSERT_TRUE(taken);
    ASSERT_EQ(taken->warnings.size(), 1u);
    EXPECT_EQ(taken->warnings[0].find("lens.blades has no effect"), 0u);
    look.glare.bloom = look.glare.veil = 0.7;
    EXPECT_FALSE(session.take(r.job, look));
}

}  // namespace
}  // namespace petzval
