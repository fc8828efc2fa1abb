#include "optics/buildable.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval::optics {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Two equiconvex elements of radius 50, n = 1.5, with an air gap.
Prescription pair(double thickness, double gap, double clear_radius) {
    Prescription lens;
    lens.aperture_kind = ApertureKind::EntrancePupilDiameter;
    lens.aperture = 10;
    for (const double sign : {1.0, -1.0, 1.0, -1.0}) {
        Surface s;
        s.curvature_per_mm = sign / 50;
        s.clear_radius_mm = clear_radius;
        s.thickness_mm = sign > 0 ? thickness : gap;
        if (sign > 0) s.after = constant_glass("", 1.5);
        lens.surfaces.push_back(s);
    }
    lens.surfaces.back().thickness_mm = 0;
    return lens;
}

// The sag of radius 50 at 15 mm: 50 - sqrt(50^2 - 15^2) = 2.3030; twice that is 4.6061.
TEST(Buildable, AThickPairHasNoDoubts) { EXPECT_THAT(build_doubts(pair(6, 1, 15)), IsEmpty()); }

TEST(Buildable, AnEdgeBelowOnePercentOfTheDiameterIsTooThin) {
    EXPECT_THAT(build_doubts(pair(4.95, 1, 15)), IsEmpty());  // edge 0.344, allowed 0.3
    EXPECT_THAT(build_doubts(pair(4.85, 1, 15)),
                ElementsAre(HasSubstr("edge between surfaces 1 and 2 is only 0.244 mm"),
                            HasSubstr("surfaces 3 and 4 is only 0.244 mm")));
}

TEST(Buildable, SurfacesThatCutEachOtherAreNamedWithTheHeight) {
    // The sag is half of 4 mm at sqrt(50^2 - 48^2) = 14.
    const auto doubts = build_doubts(pair(4, 1, 15));
    ASSERT_EQ(doubts.size(), 2u);
    EXPECT_THAT(doubts[0], HasSubstr("surfaces 1 and 2 overlap from 14.1 mm"));
    EXPECT_THAT(build_doubts(pair(6, -1, 15)), ElementsAre(HasSubstr("surfaces 2 and 3 overlap from 0 mm")));
}

TEST(Buildable, AClearRadiusBeyondTheSphereIsNamed) {
    EXPECT_THAT(build_doubts(pair(120, 120, 51))[0], HasSubstr("beyond the sphere"));
}

}  // namespace
}  // namespace petzval::optics
