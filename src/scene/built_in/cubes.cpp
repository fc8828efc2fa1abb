// Boxes one behind the other on a chequered floor, a green one in focus; glowing particles rise far behind
// and close before it: what game engines show of depth of field.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kFocus = 2.2f, kBlurTangent = 0.5f * 0.050f / 1.4f;  // the latter: radius of the aperture, m

// Particles fill a column around `at`, each rising through it; their discs show about `glow`.
void add_particles(World& world, Vec3 at, Vec3 half, int count, float radius_m, Vec3 colour, float glow,
                   float time, std::uint32_t seed) {
    for (int i = 0; i < count; ++i) {
        const auto random = [&](int what) { return cell_value(i, what, seed); };
        const float risen = random(1) + 0.6f * time, y = 2 * (risen - std::floor(risen)) - 1;
        const Vec3 place = at + half * Vec3{2 * random(0) - 1, y, 2 * random(2) - 1};
        const float own = radius_m / place.z, blur = kBlurTangent * std::abs(1 / kFocus - 1 / place.z);
        const float spread = std::max(1.0f, blur * blur / (own * own));
        world.add_lamp(place, radius_m, glow * (0.5f + random(3)) * spread * colour);
    }
}

void add_boxes(World& world) {
    static const Vec3 kColours[] = {{0.62f, 0.60f, 0.56f}, {0.14f, 0.56f, 0.20f}, {0.66f, 0.30f, 0.14f},
                                    {0.20f, 0.32f, 0.60f}, {0.70f, 0.58f, 0.20f}, {0.52f, 0.20f, 0.32f},
                                    {0.40f, 0.42f, 0.44f}};
    for (int i = 0; i < 7; ++i) {
        const float z = i == 1 ? kFocus + 0.14f : 1.05f * std::pow(1.5f, float(i)),
                    half = i == 1 ? 0.14f : 0.16f;
        const float x = i == 1 ? 0.02f : (i % 2 ? 0.16f : -0.17f) * z + 0.02f * float(i);
        Mesh cube = box({}, {half, half, half}, 12);
        cube.place(0.4f + 0.5f * float(i), {x, half, z});
        const Vec3 colour = kColours[i];
        world.add(
            std::move(cube),
            [=](const SurfacePoint& p) {
                const float side = 2 * half, edge = std::min({p.u, side - p.u, p.v, side - p.v}) / side;
                const float grain = 1 + 0.08f * noise(90.0f * p.position);
                return Matter{grain * colour * (0.55f + 0.45f * smoothstep(0.04f, 0.055f, edge)), {}};
            },
            Sides::Solid);
    }
}

void build(World& world, float time) {
    world.view = Viewpoint::looking({0.10f * time, 0.42f, 0}, {0.10f * time, 0.24f, kFocus});
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.24f, 0.25f, 0.28f}, Vec3{0.07f, 0.09f, 0.13f}, smoothstep(-0.1f, 0.3f, d.y));
    };
    world.ambient_above = {0.8f, 0.8f, 0.85f}, world.ambient_below = {0.3f, 0.3f, 0.3f};
    world.lights.push_back({{-0.6f, 0.9f, -0.4f}, {1.7f, 1.6f, 1.45f}, 0.05f, true});
    world.add(
        patch({-20, 0, 0.3f}, {40, 0, 0}, {0, 0, 40}, 120, 120),
        [](const SurfacePoint& p) {
            const float dark = checks(p.position.x / 0.35f, p.position.z / 0.35f, 0.03f);
            return Matter{mix(Vec3{0.42f, 0.41f, 0.40f}, Vec3{0.16f, 0.17f, 0.19f}, dark), {}};
        },
        Sides::Sheet);
    add_boxes(world);
    add_particles(world, {-1.6f, 0.9f, 7}, {0.7f, 0.8f, 0.7f}, 42, 0.012f, {1, 0.55f, 0.18f}, 1.2f, time,
                  711);
    add_particles(world, {1.9f, 0.9f, 8}, {0.7f, 0.8f, 0.7f}, 42, 0.012f, {0.25f, 0.65f, 1}, 1.2f, time, 712);
    add_particles(world, {0.05f, 0.36f, 0.85f}, {0.26f, 0.16f, 0.16f}, 16, 0.002f, {1, 1, 0.95f}, 0.8f, time,
                  713);
}

}  // namespace

BuiltInScene cubes() {
    return {{.name = "cubes",
             .purpose =
                 "boxes one behind the other, a green one in focus, glowing particles behind it and in front",
             .camera =
                 {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.4, .focus_distance_m = kFocus},
             .frames = 48,
             .floor_m = 0},
            build};
}

}  // namespace petzval::scene
