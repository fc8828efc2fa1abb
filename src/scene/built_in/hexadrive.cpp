// The subject of HexaDrive's demo of 2009: many bright lights at many depths out to the corners of a wide
// view, mirrors among them, a very shallow focus. A wheel of lamps turns through it, so that their pentagons
// turn over. docs/explain/published.md.
#include "scene/built_in/lamps.h"
#include "scene/built_in/scenes.h"
#include "scene/shading.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kFocus = 1.6f;                        // m
constexpr float kHalfWidth = 1.2f;                    // of the frame, tangent: 100 degrees across
constexpr float kBlurTangent = 0.5f * 0.150f / 1.0f;  // radius of the aperture, m
constexpr float kFloor = -0.55f;

// A lamp at a place in the frame, -1…1 across and up, whose disc shows about `glow`.
void lamp(World& world, float across, float up, float z, float radius_m, Vec3 tint, float glow) {
    add_disc(world, {across * kHalfWidth * z, up * kHalfWidth * 9 / 16 * z, z}, radius_m, tint, glow,
             kBlurTangent, kFocus);
}

void add_far_lamps(World& world) {
    for (int row = 0; row < 4; ++row)
        for (int i = 0; i < 11; ++i) {
            const int k = 11 * row + i;
            const float across = -0.97f + 0.194f * (float(i) + 0.35f * float(row % 2));
            lamp(world, across, 0.95f - 0.27f * float(row) + 0.08f * (cell_value(k, 0, 761) - 0.5f),
                 4 + 6 * cell_value(k, 1, 761), 0.02f, lamp_colour(5 * k),
                 0.2f + 0.9f * cell_value(k, 2, 761));
        }
}

void add_near_lamps(World& world) {
    for (int i = 0; i < 8; ++i)
        lamp(world, -0.94f + 0.268f * float(i), i % 2 ? -0.90f : -0.72f, 0.75f + 0.1f * cell_value(i, 3, 761),
             0.003f, lamp_colour(5 * i + 2), 0.6f);
}

// Around a tilted axis through the point in focus: every lamp passes before it and behind it.
void add_wheel(World& world, float time) {
    constexpr int kLamps = 14;
    for (int i = 0; i < kLamps; ++i) {
        const float angle = 2 * kPi * (float(i) + time * 2) / kLamps;
        const Vec3 at = Vec3{0, 0.12f, kFocus} +
                        Vec3{0.95f * std::cos(angle), 0.22f * std::sin(angle), 0.62f * std::sin(angle)};
        world.add_lamp(at, 0.005f, 110 * lamp_colour(i));
    }
}

// A string of bulbs in focus: they throw the stars.
void add_string(World& world) {
    for (int i = 0; i < 7; ++i) {
        const float t = float(i) / 3 - 1;
        world.add_lamp({0.85f * t, -0.02f - 0.10f * t * t, kFocus}, 0.004f,
                       90 * lamp_colour(i % 3 == 1 ? 2 : 1));
    }
}

void add_mirrors(World& world) {
    const auto ball = [&](Vec3 at, float radius, Vec3 facing) {
        world.add(
            sphere(at, {radius, radius, radius}, 48, 24),
            [&world, facing](const SurfacePoint& p) {
                return Matter{{}, mirrored(world, p, facing) + facing * gloss(world, p, 400)};
            },
            Sides::Solid);
    };
    ball({-0.42f, kFloor + 0.22f, 1.7f}, 0.22f, {0.85f, 0.86f, 0.88f});
    ball({0.36f, kFloor + 0.17f, 1.5f}, 0.17f, {0.95f, 0.72f, 0.35f});
    ball({1.15f, kFloor + 0.40f, 3.2f}, 0.40f, {0.85f, 0.55f, 0.45f});
    ball({-1.9f, kFloor + 0.55f, 4.2f}, 0.55f, {0.55f, 0.70f, 0.90f});
    ball({-0.22f, kFloor + 0.09f, 0.80f}, 0.09f, {0.9f, 0.9f, 0.9f});
}

void build(World& world, float time) {
    world.is_baked = false;
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.020f, 0.024f, 0.045f}, Vec3{0.003f, 0.004f, 0.010f},
                   smoothstep(-0.05f, 0.5f, normalised(d).y));
    };
    const Daylight moon{
        normalised({0.4f, 0.8f, -0.5f}), {0.22f, 0.24f, 0.30f}, {0.05f, 0.06f, 0.09f}, {0.02f, 0.02f, 0.02f}};
    world.add(
        patch({-60, kFloor, -60}, {120, 0, 0}, {0, 0, 120}, 1, 1),
        [&world, moon](const SurfacePoint& p) {
            const float joint = std::max(stripes(p.position.x / 0.3f, 0.03f, 0.01f),
                                         stripes(p.position.z / 0.3f, 0.03f, 0.01f));
            const float dark = checks(p.position.x / 0.3f, p.position.z / 0.3f, 0.02f);
            const Vec3 tile =
                mix(Vec3{0.30f, 0.27f, 0.24f}, Vec3{0.10f, 0.10f, 0.12f}, dark) * (1 - 0.6f * joint);
            const Vec3 shine = mirrored(world, p, {0.06f, 0.06f, 0.06f}) + 0.15f * gloss(world, p, 60);
            return Matter{{}, matt(world, moon, p, tile) + (1 - joint) * shine};
        },
        Sides::Sheet);
    add_far_lamps(world), add_near_lamps(world), add_wheel(world, time), add_string(world);
    add_mirrors(world);
}

}  // namespace

// A large format, so that 100 degrees across are shallow.
BuiltInScene hexadrive() {
    return {
        {.name = "hexadrive",
         .purpose =
             "lights at many depths out to the corners of a wide view, and mirrors, as in HexaDrive's demo",
         .camera =
             {.focal_length_mm = 150, .sensor_width_mm = 360, .f_number = 1, .focus_distance_m = kFocus},
         .frames = 48,
         .floor_m = kFloor},
        build};
}

}  // namespace petzval::scene
