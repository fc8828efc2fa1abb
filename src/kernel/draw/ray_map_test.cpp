#include "kernel/draw/ray_map.h"

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

// Any map; with cylinders, with all powers.
RayMap any_map(bool is_skew) {
    RayMap map;
    Displacement& d = map.offset_mm;
    d.is_skew = is_skew;
    for (std::size_t i = 0; i < kEvenTerms; ++i) {
        d.along[i] = 1.0 / double(i + 1), map.light[i] = double(i % 7) - 3;
        if (is_skew) d.across_even[i] = 0.2 - 0.07 * double(i % 6);
    }
    for (std::size_t i = 0; i < kOddTerms; ++i) {
        d.across[i] = 0.3 - 0.1 * double(i % 5);
        if (is_skew) d.along_odd[i] = 0.4 - 0.1 * double(i % 3), map.light_odd[i] = double(i % 5) - 2;
    }
    return map;
}

TEST(RayMap, ManyPointsLandWhereEachWouldAlone) {
    std::vector<Point> pupil;
    for (int k = 0; k < 37; ++k)
        pupil.push_back({std::cos(k) * k / 37, std::sin(1.7 * k)});  // no whole groups
    for (const bool is_skew : {false, true}) {
        const RayMap map = any_map(is_skew);
        std::vector<Point> landed(pupil.size());
        std::vector<double> lights(pupil.size());
        land(map.offset_mm, pupil, landed.data());
        lights_at(map, pupil, lights.data());
        for (std::size_t k = 0; k < pupil.size(); ++k) {
            const PupilPowers powers(pupil[k]);
            const Point alone = map.offset_mm.at(powers);
            EXPECT_NEAR(landed[k].x, alone.x, 1e-12);
            EXPECT_NEAR(landed[k].y, alone.y, 1e-12);
            EXPECT_NEAR(lights[k], light_at(map, powers), 1e-12);
        }
    }
}

}  // namespace
}  // namespace petzval::kernel
