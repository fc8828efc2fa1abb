// Everything HexaDrive's demo of 2009 showed, in one picture: lamps far behind, in and close before focus,
// all over the frame, so that a five-bladed aperture turns over, the barrel cuts discs towards the corners,
// and sharp lamps throw stars. docs/explain/published-levels.md shows it.
#include "scene/built_in/lamps.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

#include <array>

namespace petzval::scene {
namespace {

constexpr float kFocus = 1.2f;                       // m
constexpr float kHalfWidth = 18.0f / 50;             // of the frame, tangent
constexpr float kBlurTangent = 0.5f * 0.05f / 1.2f;  // radius of the aperture, m
constexpr float kFloor = -0.28f;

// A lamp at a place in the frame (-1…1 across, upwards in the same measure) whose disc shows about `glow`.
void lamp(World& world, float across, float up, float z, float radius_m, Vec3 colour, float glow) {
    add_disc(world, {across * kHalfWidth * z, up * kHalfWidth * z, z}, radius_m, colour, glow, kBlurTangent,
             kFocus);
}

void add_far_lamps(World& world) {
    for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 12; ++i) {
            const int k = 12 * row + i;
            const float across = -0.96f + 1.92f * (float(i) + 0.5f * float(row % 2)) / 11.5f;
            const float up = 0.49f - 0.145f * float(row) + 0.03f * (cell_value(k, 0, 11) - 0.5f);
            lamp(world, across, up, 6.5f + 2 * cell_value(k, 1, 11), 0.010f, lamp_colour(k * 7),
                 0.25f + 1.1f * cell_value(k, 2, 11));
        }
}

// Lamps along the bottom, close to the lens, each on a thin stalk.
void add_near_lamps(World& world) {
    Tubes stalks;
    for (int i = 0; i < 8; ++i) {
        const float across = -0.92f + 1.84f * float(i) / 7, up = -0.34f - 0.1f * float(i % 2);
        const float z = 0.52f + 0.05f * cell_value(i, 3, 11);
        lamp(world, across, up, z, 0.0012f, lamp_colour(i * 5 + 2), 0.8f);
        const Vec3 at{across * kHalfWidth * z, up * kHalfWidth * z, z + 0.003f};
        stalks.path({at, at - Vec3{0, 0.12f, 0}}, 0.0007f, 0.0012f);
    }
    world.add(std::move(stalks), [](const SurfacePoint&) { return Matter{{0.05f, 0.06f, 0.05f}, {}}; });
}

// A string of bulbs in focus; they are what throws stars.
void add_string(World& world) {
    Tubes wire;
    std::vector<Vec3> through;
    constexpr int kBulbs = 9;
    for (int i = 0; i <= 2 * kBulbs; ++i) {
        const float t = float(i) / kBulbs - 1;
        through.push_back({1.1f * t * kHalfWidth * kFocus, 0.02f + 0.055f * t * t, kFocus + 0.006f});
    }
    wire.curve(through, 4, 0.0016f, 0.0016f);
    for (int i = 0; i < kBulbs; ++i) {
        const Vec3 knot = through[std::size_t(2 * i + 1)], at = knot - Vec3{0, 0.014f, 0.006f};
        wire.line(knot, at + Vec3{0, 0.004f, 0.006f}, 0.003f);
        world.add_lamp(at, 0.0024f, 90 * (i % 3 == 1 ? lamp_colour(2) : lamp_colour(1)));
    }
    world.add(std::move(wire), [](const SurfacePoint&) { return Matter{{0.06f, 0.07f, 0.06f}, {}}; });
}

// Two jars on the table, one of them in focus.
void add_jars(World& world) {
    const std::vector<std::array<float, 2>> outline{{0, 0},          {0.050f, 0.002f}, {0.054f, 0.03f},
                                                    {0.052f, 0.11f}, {0.036f, 0.135f}, {0.038f, 0.15f},
                                                    {0, 0.152f}};
    const auto glazed = [](Vec3 light, Vec3 dark) {
        return [=](const SurfacePoint& p) {
            const float band = stripes(p.v * 9, 0.5f, 0.08f), speck = fractal_noise(60 * p.position, 2);
            return Matter{mix(dark, light, band) * (1 + 0.25f * speck), {}};
        };
    };
    world.add(lathe({-0.15f, kFloor, kFocus}, outline, 48),
              glazed({0.55f, 0.40f, 0.22f}, {0.10f, 0.17f, 0.22f}), Sides::Solid);
    world.add(lathe({0.24f, kFloor, 1.75f}, outline, 48),
              glazed({0.30f, 0.42f, 0.40f}, {0.35f, 0.12f, 0.08f}), Sides::Solid);
}

void build(World& world, float) {
    world.sky = [](Vec3) { return Vec3{0.004f, 0.006f, 0.012f}; };
    world.ambient_above = {0.05f, 0.06f, 0.10f}, world.ambient_below = {0.03f, 0.02f, 0.02f};
    world.lights.push_back({{-0.9f, 0.9f, 0.5f}, {3.2f, 2.7f, 2.0f}, 0.15f});
    world.lights.push_back({{0.8f, 1.5f, 4.5f}, {4.0f, 3.4f, 3.0f}, 0.2f});
    world.lights.push_back({{0.0f, 0.10f, 1.15f}, {0.5f, 0.42f, 0.3f}, 0.1f});
    world.add(
        patch({-6, kFloor, 0.3f}, {12, 0, 0}, {0, 0, 9}, 60, 90),
        [](const SurfacePoint& p) {
            const float plank = p.position.x / 0.11f, gap = stripes(plank, 0.06f, 0.02f);
            const float grain = noise({40 * p.position.x, 0, 3 * p.position.z});
            const float tint = 0.7f + 0.5f * cell_value(int(std::floor(plank)), 0, 5);
            return Matter{Vec3{0.20f, 0.13f, 0.08f} * (tint * (1 + 0.3f * grain) * (1 - 0.8f * gap)), {}};
        },
        Sides::Sheet);
    world.add(
        patch({-8, -2, 9.2f}, {16, 0, 0}, {0, 8, 0}, 24, 12),
        [](const SurfacePoint& p) {
            const float tone = 0.7f + 0.4f * fractal_noise(0.9f * p.position, 3);
            return Matter{{0.05f, 0.06f, 0.09f}, tone * Vec3{0.006f, 0.010f, 0.022f}};
        },
        Sides::Sheet);
    add_far_lamps(world);
    add_near_lamps(world);
    add_string(world);
    add_jars(world);
}

}  // namespace

BuiltInScene lanterns() {
    return {{.name = "lanterns",
             .purpose = "lamps far behind focus, in focus and just in front of it, out to the corners",
             .camera =
                 {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.2, .focus_distance_m = kFocus}},
            build};
}

}  // namespace petzval::scene
