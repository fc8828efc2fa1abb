#include "engine/samples/flat_surfaces.h"

#include "base/parallel.h"

#include <cmath>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

constexpr int kSize = 64, kBegin = 30, kEnd = 35;
constexpr float kDark = 0.02f;

// A wire 5 pixels wide, 12 pixels out of focus, before a wall.
struct Wire {
    Picture colour{kSize, kSize};
    Plane coc_px{kSize, kSize, 0};
    EngineView input;

    template <typename Wall>
    explicit Wire(const Wall& wall) {
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const bool inside = x >= kBegin && x < kEnd;
                const float light = inside ? kDark : wall(x, y);
                colour(x, y) = {light, light, light, 1};
                if (inside) coc_px(x, y) = -12;
            }
        input.samples.colour = colour, input.samples.coc_px = coc_px;
        input.samples.nearest_coc_px = -12, input.samples.farthest_coc_px = 0;
        input.services.workers = &one_thread();
    }
    std::shared_ptr<const FlatSurfaces> surfaces() const { return preview_surfaces(input, true); }
};

TEST(PreviewSurfaces, ContinueWhatAWireHides) {
    const auto stripes = [](int, int y) { return y / 6 % 2 == 0 ? 0.8f : 0.2f; };
    const auto found = Wire(stripes).surfaces();
    double error = 0;
    for (int y = 16; y < 48; ++y)
        for (int x = kBegin; x < kEnd; ++x) {
            const Hidden* const hidden = found->most_hidden(x, y);
            ASSERT_NE(hidden, nullptr) << x << ", " << y;
            EXPECT_EQ(hidden->coc_px, 0);
            error += std::abs(double(hidden->colour.r) - double(stripes(x, y)));
        }
    EXPECT_LT(error / (32 * (kEnd - kBegin)), 0.2) << "the mean of the stripes is 0.3 from either";
    EXPECT_EQ(found->most_hidden(kBegin - 2, 20), nullptr);
}

TEST(PreviewSurfaces, AreNotEstimatedBehindWhatIsInFocusNorWhereNobodyAsks) {
    Wire wire([](int, int) { return 0.5f; });
    EXPECT_FALSE(wire.surfaces()->hidden.ranges.empty());
    EXPECT_TRUE(preview_surfaces(wire.input, false)->hidden.ranges.empty());
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) wire.coc_px(x, y) = wire.coc_px(x, y) < 0 ? -0.5f : 12;
    wire.input.samples.nearest_coc_px = -0.5f, wire.input.samples.farthest_coc_px = 12;
    EXPECT_EQ(wire.surfaces()->most_hidden(32, 32), nullptr);
}

// The light of a pixel is what it shows of its surfaces.
TEST(PreviewSurfaces, OfAPixelSumToItsLight) {
    const Wire wire([](int x, int y) { return 0.3f + 0.2f * float((x + y) % 5); });
    const auto found = wire.surfaces();
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const Mixture* const m = found->mixtures.at(x, y);
            if (!m || !m->shows_far) continue;
            EXPECT_NEAR(m->near_colour.g + (1 - m->near_share) * m->far_colour.g, wire.colour(x, y).g, 1e-4f)
                << x << ", " << y;
        }
}

TEST(PreviewSurfaces, OfLayersSumToThoseOfThePicture) {
    const Wire wire([](int x, int y) { return 0.3f + 0.2f * float((x / 3 + y) % 5); });
    const auto whole = wire.surfaces();
    Picture key(kSize, kSize), fill(kSize, kSize);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const float part = 0.5f + 0.4f * std::sin(0.3f * float(x) + 0.2f * float(y));
            key(x, y) = part * wire.colour(x, y), fill(x, y) = (1 - part) * wire.colour(x, y);
            key(x, y).a = fill(x, y).a = 1;
        }
    const auto of_layer = [&](const Picture& layer) {
        EngineView view = wire.input;
        view.samples.picture = wire.colour, view.samples.colour = layer;
        return preview_surfaces(view, true);
    };
    const auto a = of_layer(key), b = of_layer(fill);
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            if (const Hidden* const hidden = whole->most_hidden(x, y)) {
                EXPECT_NEAR(a->most_hidden(x, y)->colour.g + b->most_hidden(x, y)->colour.g, hidden->colour.g,
                            1e-5f);
            }
            if (const Mixture* const m = whole->mixtures.at(x, y)) {
                EXPECT_NEAR(a->mixtures.at(x, y)->near_colour.g + b->mixtures.at(x, y)->near_colour.g,
                            m->near_colour.g, 1e-5f);
            }
        }
}

EngineView view_of(const Picture& colour, const Plane& coc_px, float nearest_px, float farthest_px) {
    EngineView view;
    view.samples.colour = colour, view.samples.coc_px = coc_px;
    view.samples.nearest_coc_px = nearest_px, view.samples.farthest_coc_px = farthest_px;
    view.services.workers = &one_thread();
    return view;
}

// A lamp of 3 x 3 pixels in focus, filtered over its edge: the pixels around it hold its light at the depth
// behind it, and would spread that in a disc.
TEST(PreviewSurfaces, OfALampInFocusHaveTheLightAroundIt) {
    const Rgba wall{0.01f, 0.02f, 0.03f, 1}, light{40, 30, 20, 1};
    Picture colour(24, 24, wall);
    Plane coc_px(24, 24, 8);
    for (int y = 8; y < 13; ++y)
        for (int x = 8; x < 13; ++x) {
            const bool inside = x > 8 && x < 12 && y > 8 && y < 12;
            colour(x, y) = inside ? light : wall + 0.1f * (light - wall);
            if (inside) coc_px(x, y) = 0;
        }
    const auto found = preview_surfaces(view_of(colour, coc_px, 0, 8), true);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            float blurred = 0;  // light that a disc spreads
            found->visit(colour, coc_px, x, y, 1,
                         [&](Rgba c, float radius, float) { blurred += radius > 1 ? c.r : 0; });
            if (coc_px(x, y) > 1) {
                EXPECT_NEAR(blurred, wall.r, 0.02f * light.r) << x << ", " << y;
            }
        }
}

// A blurred wire before a wall in focus, with a quarter of its colour in the columns beside it, which would
// stay sharp.
TEST(PreviewSurfaces, OfABlurredWireHaveItsColourBesideIt) {
    const Rgba wire{0.1f, 0.1f, 0.12f, 1}, wall{0.5f, 0.3f, 0.2f, 1};
    Picture colour(24, 24, wall);
    Plane coc_px(24, 24, 0);
    for (int y = 0; y < 24; ++y) {
        for (int x = 10; x < 13; ++x) colour(x, y) = wire, coc_px(x, y) = -12;
        for (const int x : {9, 13}) colour(x, y) = wall + 0.25f * (wire - wall);
    }
    const auto found = preview_surfaces(view_of(colour, coc_px, -12, 0), true);
    for (const int x : {9, 13}) {
        const Mixture* const m = found->mixtures.at(x, 12);
        ASSERT_NE(m, nullptr) << x;
        EXPECT_NEAR(m->near_share, 0.25f, 0.05f);
        EXPECT_EQ(m->near_coc_px, -12);
        EXPECT_NEAR(m->far_colour.r, wall.r, 0.01f);
        EXPECT_NEAR(m->near_colour.r, 0.25f * wire.r, 0.03f);
    }
}

}  // namespace
}  // namespace petzval::engine
