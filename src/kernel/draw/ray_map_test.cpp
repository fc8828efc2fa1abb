#include "kernel/draw/ray_map.h"

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

TEST(RayMap, ManyPointsLandWhereEachWouldAlone) {
    Displacement map;
    std::array<double, kEvenTerms> light{};
    for (std::size_t i = 0; i < kEvenTerms; ++i)
        map.along[i] = 1.0 / double(i + 1), light[i] = double(i % 7) - 3;
    for (std::size_t i = 0; i < kOddTerms; ++i) map.across[i] = 0.3 - 0.1 * double(i % 5);
    std::vector<Point> pupil;
    for (int k = 0; k < 37; ++k)
        pupil.push_back({std::cos(k) * k / 37, std::sin(1.7 * k)});  // no whole groups
    std::vector<Point> landed(pupil.size());
    std::vector<double> values(pupil.size());
    land(map, pupil, landed.data());
    values_at(light, pupil, values.data());
    for (std::size_t k = 0; k < pupil.size(); ++k) {
        const PupilPowers powers(pupil[k]);
        const Point alone = map.at(powers);
        EXPECT_NEAR(landed[k].x, alone.x, 1e-12);
        EXPECT_NEAR(landed[k].y, alone.y, 1e-12);
        double value = 0;
        for (std::size_t i = 0; i < kEvenTerms; ++i) value += light[i] * powers.even[i];
        EXPECT_NEAR(values[k], value, 1e-12);
    }
}

}  // namespace
}  // namespace petzval::kernel
