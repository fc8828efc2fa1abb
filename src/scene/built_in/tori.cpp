// Patterned tori, one behind the other, from before the lens to far behind focus: what WebGL pages show of
// depth of field. They turn.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

#include <algorithm>

namespace petzval::scene {
namespace {

constexpr float kFocus = 1.14f, kHalfWidth = 18.0f / 50;

Paint patterned(int kind, Vec3 first, Vec3 second) {
    return [=](const SurfacePoint& p) {
        float t = 0;
        if (kind == 0) t = checks(24 * p.u, 8 * p.v, 0.06f);
        if (kind == 1) t = stripes(18 * p.u, 0.5f, 0.05f);
        if (kind == 2) t = stripes(12 * p.u + 2 * p.v, 0.5f, 0.05f);
        const float speck = 1 + 0.12f * noise(60.0f * p.position);
        return Matter{speck * mix(first, second, t), {}};
    };
}

void build(World& world, float time) {
    static const Vec3 kColours[] = {{0.80f, 0.20f, 0.12f}, {0.84f, 0.62f, 0.14f}, {0.16f, 0.46f, 0.22f},
                                    {0.10f, 0.36f, 0.62f}, {0.46f, 0.18f, 0.52f}, {0.80f, 0.46f, 0.30f}};
    world.sky = [](Vec3 d) {
        // Tori see it from every side, the camera only about the horizon.
        return mix(Vec3{0.03f, 0.035f, 0.05f}, Vec3{0.10f, 0.12f, 0.17f}, std::max(0.0f, 0.5f + 2 * d.y));
    };
    world.ambient_above = {0.5f, 0.5f, 0.55f}, world.ambient_below = {0.2f, 0.2f, 0.25f};
    world.lights.push_back({{-0.6f, 0.7f, -0.6f}, {2.6f, 2.5f, 2.3f}, 0.03f, true});
    constexpr int kCount = 13;
    for (int i = 0; i < kCount; ++i) {
        const auto random = [i](int what) { return cell_value(i, what, 701); };
        // Equal steps of 1/depth; placed around the middle of the frame, each elsewhere.
        const float z = 1 / mix(1 / 0.62f, 1 / 7.0f, float(i) / (kCount - 1));
        const float turn = 2.4f * float(i), out = i == 6 ? 0.15f : 0.40f + 0.5f * random(0);
        const Vec3 at{out * std::cos(turn) * kHalfWidth * z, 0.5f * out * std::sin(turn) * kHalfWidth * z, z};
        const float spin = 2 * kPi * (time + random(1)),
                    size = 0.075f * (0.8f + 0.5f * random(2)) * std::sqrt(z);
        const Vec3 axis = normalised(Vec3{std::cos(spin), 0.8f * random(3), std::sin(spin)});
        world.add(
            torus(at, axis, size, 0.42f * size, 64, 32),
            patterned(i % 3, kColours[i % 6], i % 2 ? Vec3{0.80f, 0.78f, 0.72f} : Vec3{0.07f, 0.08f, 0.11f}),
            Sides::Solid);
    }
}

}  // namespace

BuiltInScene tori() {
    return {{.name = "tori",
             .purpose = "patterned tori that turn, from near the lens to far behind focus",
             .camera =
                 {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.8, .focus_distance_m = kFocus},
             .frames = 48},
            build};
}

}  // namespace petzval::scene
