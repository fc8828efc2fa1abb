#include "engine/samples/silhouettes/rims.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// A lamp of 3 x 3 pixels in focus at (10, 10), filtered over its edge; the pixels around have the depth
// behind.
struct Lamp {
    Picture colour{24, 24, Rgba{0.01f, 0.02f, 0.03f, 1}};
    Plane coc_px{24, 24, 8};

    explicit Lamp(Rgba light = {40, 30, 20, 1}) {
        for (int y = 8; y < 13; ++y)
            for (int x = 8; x < 13; ++x) {
                const bool inside = x > 8 && x < 12 && y > 8 && y < 12;
                colour(x, y) = inside ? light : colour(0, 0) + 0.1f * (light - colour(0, 0));
                if (inside) coc_px(x, y) = 0;
            }
    }
    Rims rims() const {
        return find_rims(colour, colour, coc_px, find_touched(coc_px, one_thread()), one_thread());
    }
};

TEST(Rims, OfALampAreTakenApartIntoItsLightAndWhatIsBehind) {
    const Lamp lamp;
    const Rims rims = lamp.rims();
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const bool lit = x >= 8 && x < 13 && y >= 8 && y < 13, inside = lamp.coc_px(x, y) == 0;
            const Rim* const rim = rims.at(x, y);
            ASSERT_EQ(rim != nullptr, lit && !inside) << x << ", " << y;
            if (!rim) continue;
            EXPECT_NEAR(rim->share, 0.1f, 1e-3f);
            EXPECT_EQ(rim->near_coc_px, 0);
            EXPECT_NEAR(rim->far.r, 0.01f, 1e-4f);
            const Rgba sum = rim->near(lamp.colour(x, y)) + (1 - rim->share) * rim->far;
            EXPECT_NEAR(sum.r, lamp.colour(x, y).r, 1e-4f);
            EXPECT_NEAR(sum.a, 1, 1e-4f);
        }
}

TEST(Rims, AreNoneWhereNothingIsNearer) {
    Lamp far;
    far.coc_px = Plane(24, 24, 8);
    EXPECT_TRUE(far.rims().empty());
}

// A blurred wire in columns 10…12 before a wall in focus; a quarter of its colour in the columns beside it.
TEST(Rims, OfAWireAreTakenApartByShapeAndColour) {
    const Rgba wire{0.1f, 0.1f, 0.12f, 1}, wall{0.5f, 0.3f, 0.2f, 1};
    Picture colour(24, 24, wall);
    Plane coc_px(24, 24, 0);
    for (int y = 0; y < 24; ++y) {
        for (int x = 10; x < 13; ++x) colour(x, y) = wire, coc_px(x, y) = -12;
        for (const int x : {9, 13}) colour(x, y) = wall + 0.25f * (wire - wall);
    }
    const Image<Touched> touched = find_touched(coc_px, one_thread());
    EXPECT_EQ(touched(9, 5), Touched::ByNearer);
    EXPECT_EQ(touched(10, 5), Touched::ByFarther);
    EXPECT_EQ(touched(11, 5), Touched::Clean);
    const Rims rims = find_rims(colour, colour, coc_px, touched, one_thread());
    for (int x = 0; x < 24; ++x) {
        const Rim* const rim = rims.at(x, 12);
        ASSERT_EQ(rim != nullptr, x == 9 || x == 13) << x;
        if (!rim) continue;
        EXPECT_NEAR(rim->share, 0.25f, 1e-3f);
        EXPECT_EQ(rim->near_coc_px, -12);
        EXPECT_NEAR(rim->far.r, wall.r, 1e-3f);
        EXPECT_NEAR(rim->near(colour(x, 12)).r, 0.25f * wire.r, 1e-3f);
    }
}

// A pixel brighter than all around is not a mixture: what is behind keeps its light.
TEST(Rims, MakeNothingDarkerOrBrighterThanItWas) {
    Picture colour(24, 24, Rgba{0.2f, 0.2f, 0.2f, 1});
    Plane coc_px(24, 24, 0);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 10; ++x) colour(x, y) = {0.05f, 0.05f, 0.05f, 1}, coc_px(x, y) = -12;
    colour(10, 12) = {3, 3, 3, 1};
    const Rims rims = find_rims(colour, colour, coc_px, find_touched(coc_px, one_thread()), one_thread());
    const Rim* const rim = rims.at(10, 12);
    if (!rim) return;
    EXPECT_NEAR(rim->far.r, 3, 1e-4f);
    EXPECT_NEAR((rim->near(colour(10, 12)) + (1 - rim->share) * rim->far).r, 3, 0.3f);
}

}  // namespace
}  // namespace petzval::engine
