// Thin bars at three depths, one of them in focus, with points of light placed behind their edges: what an
// engine does to silhouettes shows here without anything else in the way.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kNear = 1.1f, kFocus = 3, kFar = 8, kLampDepth = 11, kWall = 14;

Paint painted(Vec3 albedo, Vec3 band, float pitch) {
    return [=](const SurfacePoint& p) {
        const float along = p.position.x * 0.6f + p.position.y;
        return Matter{mix(albedo, band, stripes(along / pitch, 0.4f, 0.06f)), {}};
    };
}

Matter wall(const SurfacePoint& p) {
    const Vec3 q = p.position;
    const float tile = checks(q.x / 0.55f, q.y / 0.55f, 0.04f);
    const float tint = fractal_noise({0.5f * q.x, 0.5f * q.y, 3}, 3);
    const Vec3 base = mix(Vec3{0.10f, 0.15f, 0.20f}, Vec3{0.26f, 0.24f, 0.30f}, tile);
    return {base * (1 + 0.3f * tint), {}};
}

// A bar at depth z between two points of the picture, in units of half its width, y up.
void bar(Tubes& tubes, float z, float x0, float y0, float x1, float y1, float radius_m) {
    const float half = 0.5f * 36 / 85 * z;
    tubes.line({half * x0, half * y0, z}, {half * x1, half * y1, z}, radius_m);
}

void add_lamps(World& world) {
    const float half = 0.5f * 36 / 85 * kLampDepth;
    const Vec3 colours[] = {
        {1, 0.62f, 0.25f}, {0.55f, 0.75f, 1}, {1, 0.12f, 0.10f}, {0.25f, 1, 0.45f}, {1, 0.9f, 0.75f}};
    // Lamps along the edges of near and focused bars, and a few in the open.
    for (int i = 0; i < 34; ++i) {
        const float x = -0.93f + 1.86f * cell_value(i, 0, 5);
        const float y = -0.5f + cell_value(i, 1, 5);
        const float strength = 60 * std::exp2(4.5f * cell_value(i, 2, 5));
        world.add_lamp({half * x, half * y, kLampDepth + 2 * cell_value(i, 3, 5)},
                       0.0035f + 0.004f * cell_value(i, 4, 5), strength * colours[i % 5]);
    }
}

void build(World& world, float) {
    world.ambient_above = {0.9f, 0.95f, 1.05f}, world.ambient_below = {0.35f, 0.3f, 0.3f};
    world.sky = [](Vec3) { return Vec3{0.2f, 0.21f, 0.23f}; };
    world.lights.push_back({{-0.6f, 0.7f, -0.5f}, {1.0f, 0.92f, 0.8f}, 0.02f, true});
    Tubes near, focus, far;
    for (int i = 0; i < 4; ++i) {
        const float x = -0.75f + 0.5f * float(i);
        bar(near, kNear, x - 0.12f, -0.75f, x + 0.12f, 0.75f, 0.0016f + 0.0012f * float(i));
    }
    bar(near, kNear, -1.2f, 0.33f, 1.2f, 0.42f, 0.002f);
    for (int i = 0; i < 7; ++i) {
        const float x = -0.9f + 0.3f * float(i);
        bar(focus, kFocus, x + 0.16f, -0.75f, x - 0.16f, 0.75f, 0.003f + 0.0015f * float(i));
    }
    bar(focus, kFocus, -1.2f, -0.3f, 1.2f, -0.38f, 0.006f);
    for (int i = 0; i < 5; ++i) {
        const float y = -0.45f + 0.22f * float(i);
        bar(far, kFar, -1.3f, y - 0.08f, 1.3f, y + 0.08f, 0.01f + 0.004f * float(i));
    }
    for (int i = 0; i < 3; ++i)
        bar(far, kFar, -0.5f + 0.55f * float(i), -0.8f, -0.45f + 0.55f * float(i), 0.8f, 0.02f);
    world.add(std::move(near), painted({0.03f, 0.10f, 0.12f}, {0.05f, 0.16f, 0.18f}, 0.05f));
    world.add(std::move(focus), painted({0.62f, 0.20f, 0.06f}, {0.75f, 0.70f, 0.62f}, 0.06f));
    world.add(std::move(far), painted({0.50f, 0.48f, 0.42f}, {0.20f, 0.26f, 0.24f}, 0.4f));
    add_lamps(world);
    world.add(patch({-8, -5, kWall}, {16, 0, 0}, {0, 10, 0}, 24, 16), wall, Sides::Sheet);
}

}  // namespace

BuiltInScene bars() {
    return {{.name = "bars",
             .purpose = "thin bars in front of, in and behind focus, with HDR points behind their edges",
             .camera = {.focal_length_mm = 85, .sensor_width_mm = 36, .f_number = 2, .focus_distance_m = 3}},
            build};
}

}  // namespace petzval::scene
