// The scene of the articles on Unity's depth of field: cubes one behind the other, a green one the subject,
// that walks; two systems of glowing balls behind it, one of white balls in front of it.
// docs/explain/published.md.
#include "scene/built_in/scenes.h"
#include "scene/shading.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kFocus = 2.4f;
const Daylight kDay{
    normalised({-0.6f, 0.9f, -0.5f}), {2.3f, 2.2f, 2.0f}, {0.7f, 0.75f, 0.85f}, {0.3f, 0.28f, 0.26f}};

// Moves between 2 m and 2.8 m.
float subject_z(float time) { return kFocus - 0.4f * std::cos(2 * kPi * time); }

Paint lit(const World& world, std::function<Vec3(const SurfacePoint&)> albedo) {
    return [&world, albedo = std::move(albedo)](const SurfacePoint& p) {
        return Matter{{}, matt(world, kDay, p, albedo(p))};
    };
}

void add_cube(World& world, Vec3 at, float half, float turn, Vec3 colour) {
    Mesh cube = box({}, {half, half, half}, 1);
    cube.place(turn, at);
    world.add(std::move(cube),
              lit(world,
                  [=](const SurfacePoint& p) {
                      const float side = 2 * half, edge = std::min({p.u, side - p.u, p.v, side - p.v}) / side;
                      return colour * (0.55f + 0.45f * smoothstep(0.04f, 0.055f, edge));
                  }),
              Sides::Solid);
}

// Balls that rise through a box around `at`, and begin below again.
void add_balls(World& world, Vec3 at, Vec3 half, int count, float radius_m, Vec3 glow, float time,
               std::uint32_t seed) {
    Mesh balls;
    for (int i = 0; i < count; ++i) {
        const auto random = [&](int what) { return cell_value(i, what, seed); };
        const float risen = random(1) + time, y = 2 * (risen - std::floor(risen)) - 1;
        const float radius = radius_m * (0.6f + 0.8f * random(3));
        balls.append(sphere(at + half * Vec3{2 * random(0) - 1, y, 2 * random(2) - 1},
                            {radius, radius, radius}, 16, 8));
    }
    world.add(
        std::move(balls),
        [=](const SurfacePoint&) {
            return Matter{{}, glow};
        },
        Sides::Solid);
}

void build(World& world, float time) {
    static const Vec3 kColours[] = {{0.62f, 0.60f, 0.56f}, {0.66f, 0.30f, 0.14f}, {0.20f, 0.32f, 0.60f},
                                    {0.70f, 0.58f, 0.20f}, {0.52f, 0.20f, 0.32f}, {0.40f, 0.42f, 0.44f}};
    world.is_baked = false;
    world.view = Viewpoint::looking({0, 0.65f, 0}, {0, 0.36f, kFocus});
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.20f, 0.21f, 0.24f}, Vec3{0.05f, 0.07f, 0.11f},
                   smoothstep(-0.1f, 0.4f, normalised(d).y));
    };
    world.add(patch({-30, 0, 0.1f}, {60, 0, 0}, {0, 0, 40}, 1, 1),
              lit(world,
                  [](const SurfacePoint& p) {
                      const float dark = checks(p.position.x / 0.4f, p.position.z / 0.4f, 0.03f);
                      return mix(Vec3{0.40f, 0.40f, 0.39f}, Vec3{0.18f, 0.19f, 0.21f}, dark);
                  }),
              Sides::Sheet);
    for (int i = 0; i < 6; ++i) {
        const float z = 1.45f * std::pow(1.4f, float(i));
        add_cube(world, {(i % 2 ? 0.19f : -0.19f) * z, 0.14f, z}, 0.14f, 0.4f + 0.5f * float(i), kColours[i]);
    }
    add_cube(world, {0, 0.13f, subject_z(time)}, 0.13f, 0.5f, {0.12f, 0.62f, 0.18f});
    add_balls(world, {-1.9f, 0.9f, 6.5f}, {0.8f, 0.9f, 0.7f}, 48, 0.022f, {16, 7, 2}, time, 751);
    add_balls(world, {2.1f, 0.9f, 8}, {0.9f, 0.9f, 0.7f}, 48, 0.025f, {3, 8, 17}, time, 752);
    add_balls(world, {0, 0.62f, 1.0f}, {0.34f, 0.16f, 0.15f}, 16, 0.005f, {7, 7, 6.6f}, time, 753);
}

}  // namespace

BuiltInScene unity() {
    return {
        {.name = "unity",
         .purpose = "cubes and a green one that walks, glowing and white balls, as in articles about Unity",
         .camera = {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1, .focus_distance_m = 2},
         .frames = 48,
         .floor_m = 0},
        build,
        [](float time) {
            return Vec3{0, 0.13f, subject_z(time) - 0.17f};
        }};
}

}  // namespace petzval::scene
