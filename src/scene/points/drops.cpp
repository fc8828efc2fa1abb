// Rain drops and specks on the front glass: a hand's breadth in front of the pupil, far out of focus, each a
// small lens that holds some of the light in front of it.
#include "scene/points/point_sets.h"

namespace petzval::scene {
namespace {

constexpr Vec3 kDay{0.80f, 0.90f, 1}, kLamp{1, 0.70f, 0.38f};

std::vector<LightPoint> make(const PointView& view, int count, std::uint64_t seed) {
    std::vector<LightPoint> points;
    points.reserve(std::size_t(count));
    Dice dice(seed, 4);
    for (int i = 0; i < count; ++i) {
        LightPoint drop;
        // Drops extend beyond the frame: half of a disc may reach into it.
        drop.x = float(view.width) * dice.between(-0.15f, 1.15f);
        drop.y = float(view.height) * dice.between(-0.15f, 1.15f);
        drop.depth_m = dice.between(0.06f, 0.11f);
        const float size = dice.share(), diameter_m = mix(0.4e-3f, 2.6e-3f, size * size);
        drop.diameter_px = diameter_m / drop.depth_m * view.focal_px;
        const float glow = mix(4.0f, 40.0f, dice.share() * dice.share());
        const Vec3 light =
            glow * 0.25f * kPi * drop.diameter_px * drop.diameter_px * mix(kDay, kLamp, dice.share());
        drop.r = light.x, drop.g = light.y, drop.b = light.z;
        points.push_back(drop);
    }
    return points;
}

}  // namespace

PointSet drops() {
    return {{"drops", "rain drops on the front of the lens, far out of focus", 24, false}, make};
}

}  // namespace petzval::scene
