#include "engine/samples/bright_rims.h"

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
    BrightRims rims() const { return BrightRims::find(colour, coc_px, one_thread()); }
};

TEST(BrightRims, AreTakenApartIntoTheLampsLightAndWhatIsBehind) {
    const Lamp lamp;
    const BrightRims rims = lamp.rims();
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const bool lit = x >= 8 && x < 13 && y >= 8 && y < 13, inside = lamp.coc_px(x, y) == 0;
            const BrightRim* const rim = rims.at(x, y);
            ASSERT_EQ(rim != nullptr, lit && !inside) << x << ", " << y;
            if (!rim) continue;
            EXPECT_NEAR(rim->share, 0.1f, 1e-3f);
            EXPECT_EQ(rim->near_coc_px, 0);
            EXPECT_NEAR(rim->far.r, 0.01f, 1e-4f);
            const Rgba sum = rim->near + (1 - rim->share) * rim->far;
            EXPECT_NEAR(sum.r, lamp.colour(x, y).r, 1e-4f);
            EXPECT_NEAR(sum.a, 1, 1e-4f);
        }
    const Plane radii = rims.radii(lamp.coc_px);
    EXPECT_EQ(radii(8, 10), 0);
    EXPECT_EQ(radii(7, 10), 8);
}

TEST(BrightRims, AreNoneWhereNothingIsBrighterOrNearer) {
    EXPECT_TRUE(Lamp({0.001f, 0.001f, 0.001f, 1}).rims().empty()) << "a dark thing";
    Lamp far;
    far.coc_px = Plane(24, 24, 8);
    EXPECT_TRUE(far.rims().empty()) << "a lamp as deep as what is around";
    Lamp shadow;
    shadow.colour = Picture(24, 24, {40, 30, 20, 1});
    EXPECT_TRUE(shadow.rims().empty()) << "as bright behind";
}

}  // namespace
}  // namespace petzval::engine
