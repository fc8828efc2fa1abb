// Rows of large lights close before the lens, and of small ones far behind, out to the corners of the frame:
// every place of the picture shows what the barrel and the blades make of a light on either side of focus.
#include "scene/built_in/lamps.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

#include <array>

namespace petzval::scene {
namespace {

constexpr float kFocus = 2, kHalfWidth = 18.0f / 35, kBlurTangent = 0.5f * 0.035f / 1.4f;
constexpr std::array<Vec3, 5> kColours{
    {{1, 0.64f, 0.30f}, {0.55f, 0.76f, 1}, {1, 0.90f, 0.76f}, {1, 0.26f, 0.20f}, {0.36f, 1, 0.55f}}};

// A lamp at a place in the frame, -1…1 across and up, whose disc shows about `glow`.
Vec3 add_light(World& world, float across, float up, float z, float radius_m, int colour, float glow) {
    const Vec3 at{across * kHalfWidth * z, up * kHalfWidth * 9 / 16 * z, z};
    add_disc(world, at, radius_m, kColours[std::size_t(colour % 5)], glow, kBlurTangent, kFocus);
    return at;
}

void build(World& world, float) {
    world.sky = [](Vec3) { return Vec3{0.004f, 0.005f, 0.010f}; };
    world.ambient_above = {0.10f, 0.11f, 0.15f}, world.ambient_below = {0.05f, 0.04f, 0.04f};
    world.lights.push_back({{0.2f, 1.2f, 1.0f}, {2.2f, 1.9f, 1.5f}, 0.1f});
    Tubes stalks;
    for (int row = 0; row < 2; ++row)
        for (int i = 0; i < 7; ++i) {
            const float across = -0.93f + 0.31f * float(i), up = row == 0 ? 0.86f : -0.86f;
            const Vec3 at = add_light(world, across, up, 0.36f, 0.004f, i + 2 * row, 1.1f);
            const Vec3 behind = at + Vec3{0, 0, 0.004f}, away{0, row == 0 ? 0.08f : -0.08f, 0};
            stalks.line(behind, behind + away, 0.0015f);
        }
    for (int row = 0; row < 5; ++row)
        for (int i = 0; i < 9; ++i)
            add_light(world, -0.96f + 0.24f * float(i), -0.5f + 0.25f * float(row), 9 + 0.5f * float(row),
                      0.012f, 3 * i + row, 0.5f + 0.7f * cell_value(i, row, 731));
    world.add(std::move(stalks), [](const SurfacePoint&) { return Matter{{0.06f, 0.06f, 0.06f}, {}}; });
    for (int i = 0; i < 3; ++i)
        world.add(
            sphere({0.42f * float(i - 1), -0.10f, kFocus}, {0.11f, 0.11f, 0.11f}, 48, 24),
            [i](const SurfacePoint& p) {
                const float band = i == 1 ? checks(12 * p.u, 6 * p.v, 0.06f) : stripes(8 * p.v, 0.5f, 0.06f);
                return Matter{mix(Vec3{0.75f, 0.72f, 0.66f}, Vec3{0.10f, 0.16f, 0.26f}, band), {}};
            },
            Sides::Solid);
    world.add(
        patch({-10, -0.21f, 0.6f}, {20, 0, 0}, {0, 0, 12}, 60, 60),
        [](const SurfacePoint& p) {
            const float plank = stripes(p.position.x / 0.16f, 0.94f, 0.03f);
            return Matter{Vec3{0.22f, 0.16f, 0.11f} * (0.5f + 0.5f * plank), {}};
        },
        Sides::Sheet);
}

}  // namespace

BuiltInScene rows() {
    return {{.name = "rows",
             .purpose = "rows of large near lights and small far ones, out to the corners",
             .camera =
                 {.focal_length_mm = 35, .sensor_width_mm = 36, .f_number = 1.4, .focus_distance_m = kFocus}},
            build};
}

}  // namespace petzval::scene
