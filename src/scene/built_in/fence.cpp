// A school yard through a chain-link fence: thin wires and leaves far out of focus, fine detail in focus
// behind them. What the wires hide has to come back, which no picture with depth holds.
#include "scene/built_in/plants.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 0.85f, kBench = 3.8f, kWall = 5.6f;

// Zigzag wires that hook into their neighbours; the sheet turns away to the right.
void add_mesh(World& world) {
    constexpr float kSide = 0.027f;  // half a diamond's diagonal, m
    Tubes wires;
    const auto on_sheet = [](float x, float y, float z) { return Vec3{x, y, 0.90f + 0.22f * x + z}; };
    for (int column = -18; column <= 34; ++column) {
        std::vector<Vec3> through;
        for (int row = -14; row <= 14; ++row) {
            const bool right = row % 2 != 0;
            const float x = kSide * float(column) + (right ? 0.5f : -0.5f) * kSide;
            // Each wire passes before one neighbour and behind the other.
            through.push_back(on_sheet(x + (right ? 0.0012f : -0.0012f),
                                       kEyeHeight + kSide * (float(row) + (column & 1 ? 1.0f : 0.0f)),
                                       (right ? 0.0016f : -0.0016f)));
        }
        wires.path(through, 0.0013f, 0.0013f);
    }
    Tubes rail;
    rail.line(on_sheet(-0.6f, kEyeHeight + 0.155f, 0), on_sheet(1.2f, kEyeHeight + 0.165f, 0), 0.009f);
    const Paint zinc = [](const SurfacePoint& p) {
        const float rust = smoothstep(0.1f, 0.5f, noise(30.0f * p.position));
        return Matter{mix(Vec3{0.42f, 0.43f, 0.44f}, Vec3{0.30f, 0.15f, 0.07f}, rust), {}};
    };
    world.add(std::move(wires), zinc);
    world.add(std::move(rail), zinc);
    const Foliage ivy{{0.12f, 0.09f, 0.05f}, {0.10f, 0.26f, 0.05f}, {0.22f, 0.36f, 0.08f}, 0.034f};
    add_twig(world, {-0.24f, kEyeHeight + 0.15f, 0.83f}, {-0.13f, kEyeHeight - 0.02f, 0.85f}, 9, ivy, 41);
    add_twig(world, {-0.22f, kEyeHeight - 0.14f, 0.82f}, {-0.06f, kEyeHeight - 0.09f, 0.86f}, 8, ivy, 42);
    add_twig(world, {0.26f, kEyeHeight - 0.15f, 0.94f}, {0.17f, kEyeHeight + 0.01f, 0.93f}, 8, ivy, 43);
}

Vec3 wood(Vec3 p, Vec3 base) {
    const float grain = noise({3 * p.x, 60 * p.y, 60 * p.z}) + 0.6f * noise({9 * p.x, 150 * p.y, 150 * p.z});
    return base * (1 + 0.28f * grain);
}

void add_bench(World& world) {
    const auto plank = [&](Vec3 centre, Vec3 half) {
        world.add(
            box(centre, half, 12),
            [](const SurfacePoint& p) {
                return Matter{wood(p.position, {0.44f, 0.27f, 0.14f}), {}};
            },
            Sides::Solid);
    };
    for (int i = 0; i < 3; ++i)
        plank({0.02f, 0.43f, kBench - 0.13f + 0.14f * float(i)}, {0.92f, 0.016f, 0.06f});
    for (int i = 0; i < 2; ++i)
        plank({0.02f, 0.66f + 0.15f * float(i), kBench + 0.28f + 0.03f * float(i)}, {0.92f, 0.055f, 0.014f});
    Tubes iron;
    for (const float x : {-0.72f, 0.76f}) {
        iron.curve({{x, 0, kBench - 0.2f}, {x, 0.41f, kBench - 0.17f}}, 1, 0.02f, 0.02f);
        iron.curve({{x, 0, kBench + 0.34f}, {x, 0.41f, kBench + 0.22f}, {x, 0.92f, kBench + 0.36f}}, 8, 0.02f,
                   0.018f);
        iron.line({x, 0.40f, kBench - 0.17f}, {x, 0.40f, kBench + 0.22f}, 0.018f);
    }
    world.add(std::move(iron), [](const SurfacePoint&) { return Matter{{0.06f, 0.09f, 0.08f}, {}}; });
}

Matter basketball(const SurfacePoint& p) {
    const float x = p.u * 4,
                seam = std::min({std::abs(x - std::round(x)) * 0.9f, std::abs(p.v - 0.5f) * 2.4f});
    const float pebble = 1 + 0.10f * noise(230.0f * p.position);
    return {
        pebble * mix(Vec3{0.05f, 0.04f, 0.04f}, Vec3{0.62f, 0.24f, 0.07f}, smoothstep(0.028f, 0.045f, seam)),
        {}};
}

Matter crate(const SurfacePoint& p) {
    const float slat = stripes(p.v / 0.085f, 0.9f, 0.03f);
    const bool mark = p.normal.z < -0.5f && std::abs(p.u - 0.2f) < 0.07f && std::abs(p.v - 0.13f) < 0.05f;
    const float letters =
        mark ? checks(p.u / 0.012f, p.v / 0.02f, 0.1f) * stripes(p.u / 0.047f, 0.8f, 0.03f) : 0;
    const Vec3 base = wood(p.position, {0.58f, 0.45f, 0.28f});
    return {mix(mix(Vec3{0.10f, 0.07f, 0.04f}, base, slat), {0.30f, 0.05f, 0.05f}, 0.85f * letters), {}};
}

// A jumper left on the bench: knitted rows.
Matter knitted(const SurfacePoint& p) {
    const float v = p.v * 26, u = p.u * 60;
    const float loop = 0.75f + 0.25f * std::cos(2 * kPi * (u + 0.25f * std::sin(2 * kPi * v)));
    const float band = stripes(p.v * 5, 0.45f, 0.03f);
    return {loop * mix(Vec3{0.62f, 0.58f, 0.48f}, Vec3{0.10f, 0.22f, 0.42f}, band), {}};
}

void add_things(World& world) {
    world.add(sphere({-0.34f, 0.446f + 0.12f, kBench}, {0.12f, 0.12f, 0.12f}, 64, 32), basketball,
              Sides::Solid);
    Mesh box_of_wood = box({}, {0.2f, 0.13f, 0.14f}, 14);
    box_of_wood.place(0.3f, {0.34f, 0.446f + 0.13f, kBench + 0.02f});
    world.add(std::move(box_of_wood), crate, Sides::Solid);
    world.add(sphere({0.36f, 0.77f, kBench + 0.02f}, {0.17f, 0.075f, 0.11f}, 64, 32), knitted, Sides::Solid);
    world.add(
        sphere({-0.02f, 0.505f, kBench - 0.05f}, {0.06f, 0.06f, 0.06f}, 40, 20),
        [](const SurfacePoint& p) {
            return Matter{mix(Vec3{0.65f, 0.62f, 0.1f}, Vec3{0.8f, 0.8f, 0.7f},
                              stripes(3 * p.u + 0.6f * std::sin(2 * kPi * p.v), 0.06f, 0.02f)),
                          {}};
        },
        Sides::Solid);
}

Matter bricks(const SurfacePoint& p) {
    const float x = p.position.x, y = p.position.y;
    const Brick b = brick(x / 0.225f, y / 0.075f, 0.05f, 0.15f);
    const float shade = 0.7f + 0.5f * cell_value(b.column, b.row, 8);
    Vec3 colour =
        mix(Vec3{0.42f, 0.16f, 0.10f}, Vec3{0.46f, 0.27f, 0.16f}, cell_value(b.column, b.row, 9)) * shade;
    // A mural over the bricks: a sun with rays.
    const float dx = x + 0.15f, dy = y - 1.15f, r = std::sqrt(dx * dx + dy * dy);
    const float rays = stripes(std::atan2(dy, dx) * 18 / (2 * kPi), 0.5f, 0.05f) *
                       smoothstep(0.46f, 0.48f, r) * smoothstep(0.82f, 0.80f, r);
    const float disc = smoothstep(0.40f, 0.385f, r), ring = disc * smoothstep(0.30f, 0.315f, r);
    const float worn = smoothstep(-0.75f, -0.45f, fractal_noise({5 * x, 5 * y, 1}, 3));
    colour = mix(colour, {0.80f, 0.55f, 0.12f}, 0.9f * worn * disc);
    colour = mix(colour, {0.72f, 0.24f, 0.08f}, 0.9f * worn * ring);
    colour = mix(colour, {0.78f, 0.70f, 0.48f}, 0.9f * worn * rays);
    return {mix(colour, Vec3{0.44f, 0.42f, 0.38f}, b.mortar), {}};
}

Matter yard(const SurfacePoint& p) {
    const Vec3 q = p.position;
    const float line = smoothstep(0.045f, 0.04f, std::abs(q.z - 4.9f + 0.1f * q.x)) +
                       smoothstep(0.045f, 0.04f, std::abs(q.x - 0.3f * q.z + 2.1f));
    const float grit = 1 + 0.15f * noise(55.0f * q) + 0.2f * fractal_noise(1.5f * q, 2);
    return {grit * mix(Vec3{0.20f, 0.20f, 0.21f}, Vec3{0.72f, 0.70f, 0.64f}, std::min(1.0f, line)), {}};
}

// Trees and a house in the sun, beyond the end of the wall.
void add_distance(World& world) {
    world.add(
        patch({-2, 0, 22}, {20, 0, 0}, {0, 9, 0}, 10, 6),
        [](const SurfacePoint& p) {
            const Vec3 q = p.position;
            const float window = stripes(q.x / 1.7f, 0.4f, 0.02f) * stripes(q.y / 2.2f - 0.4f, 0.5f, 0.02f);
            return Matter{mix(Vec3{0.66f, 0.56f, 0.42f}, Vec3{0.10f, 0.13f, 0.17f}, window), {}};
        },
        Sides::Sheet);
    for (int i = 0; i < 7; ++i) {
        const float x = 2.6f + 1.3f * float(i % 4) + 0.4f * cell_value(i, 0, 61),
                    z = 10 + 1.6f * std::floor(0.5f * float(i));
        const float size = 0.9f + 0.5f * cell_value(i, 1, 61);
        world.add(
            sphere({x, 1.4f + 0.8f * cell_value(i, 2, 61), z}, {size, 1.2f * size, size}, 24, 14),
            [](const SurfacePoint& p) {
                const float tuft = fractal_noise(5.0f * p.position, 3);
                return Matter{
                    mix(Vec3{0.05f, 0.12f, 0.03f}, Vec3{0.34f, 0.40f, 0.10f}, smoothstep(-0.7f, 0.9f, tuft)),
                    {}};
            },
            Sides::Solid);
    }
}

void build(World& world, float time) {
    world.view.position = {0.10f * time, kEyeHeight, 0};
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.75f, 0.80f, 0.85f}, Vec3{0.28f, 0.45f, 0.75f}, smoothstep(0, 0.5f, d.y));
    };
    world.ambient_above = {1.2f, 1.5f, 1.9f}, world.ambient_below = {0.5f, 0.45f, 0.4f};
    world.lights.push_back({{-0.55f, 0.75f, -0.55f}, {2.3f, 2.05f, 1.65f}, 0.02f, true});
    add_mesh(world);
    add_bench(world);
    add_things(world);
    world.add(patch({-6, 0, kWall}, {7.05f, 0, 0}, {0, 4, 0}, 70, 40), bricks, Sides::Sheet);
    world.add(patch({-8, 0, 1.5f}, {24, 0, 0}, {0, 0, 21}, 96, 84), yard, Sides::Sheet);
    add_distance(world);
}

}  // namespace

BuiltInScene fence() {
    return {{.name = "fence",
             .purpose = "thin wires and leaves far out of focus in front of texture in focus",
             .camera =
                 {.focal_length_mm = 70, .sensor_width_mm = 36, .f_number = 2.8, .focus_distance_m = kBench},
             .frames = 48},
            build};
}

}  // namespace petzval::scene
