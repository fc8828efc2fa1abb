// A laid table that runs from near the lens through focus to its far end, with balls standing on it: soft
// contact shadows, round silhouettes, a continuous ground.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kTableEnd = 2.7f, kWall = 4.6f;

Matter cloth(const SurfacePoint& p) {
    const float x = p.position.x / 0.055f, z = p.position.z / 0.055f;
    // Gingham: stripes of dyed thread both ways.
    const float dyed = 0.5f * (stripes(x, 0.5f, 0.05f) + stripes(z + 0.3f, 0.5f, 0.05f));
    const float weave = 1 + 0.06f * noise({320 * p.position.x, 3, 140 * p.position.z});
    const float hem = smoothstep(0.02f, 0.03f, kTableEnd - p.position.z);
    const Vec3 white{0.78f, 0.76f, 0.70f}, dye{0.13f, 0.24f, 0.42f};
    return {(0.6f + 0.4f * hem) * weave * mix(white, dye, dyed), {}};
}

Matter room(const SurfacePoint& p) {
    const float x = p.position.x, y = p.position.y;
    const Vec3 panel = Vec3{0.34f, 0.25f, 0.18f} * (0.8f + 0.2f * stripes(x / 0.31f, 0.93f, 0.03f)) *
                       (1 + 0.25f * fractal_noise({9 * x, 0.8f * y, 2}, 2));
    // A window of four panes on the left, two pictures on the right.
    const auto inside = [](float v, float from, float to) {
        return smoothstep(from, from + 0.01f, v) * (1 - smoothstep(to - 0.01f, to, v));
    };
    const float pane = (inside(x, -1.32f, -0.92f) + inside(x, -0.86f, -0.46f)) *
                       (inside(y, 0.16f, 0.52f) + inside(y, 0.58f, 1.1f));
    const float frame = inside(x, -1.39f, -0.39f) * inside(y, 0.09f, 1.2f);
    const float picture = inside(x, 0.55f, 1.0f) * inside(y, 0.2f, 0.75f),
                border = inside(x, 0.51f, 1.04f) * inside(y, 0.16f, 0.79f);
    const Vec3 painting = mix(Vec3{0.55f, 0.20f, 0.10f}, Vec3{0.12f, 0.30f, 0.32f},
                              smoothstep(0.35f, 0.55f, y + 0.08f * std::sin(9 * x)));
    Vec3 albedo = mix(panel, {0.7f, 0.68f, 0.62f}, frame);
    albedo = mix(mix(albedo, {0.75f, 0.6f, 0.25f}, border), painting, picture);
    const Vec3 outdoors = mix(Vec3{0.9f, 1.1f, 0.55f}, Vec3{1.5f, 1.7f, 2.0f},
                              smoothstep(0.3f, 0.7f, y + 0.1f * noise({6 * x, 4 * y, 0})));
    return {albedo * (1 - pane), pane * outdoors};
}

// Balls: 0 plain, 1 striped, 2 checked, 3 orange peel, 4 swirled.
Paint ball(int kind, Vec3 colour, Vec3 second) {
    return [=](const SurfacePoint& p) {
        float t = 0;
        if (kind == 1) t = stripes(6 * p.v + 0.2f, 0.42f, 0.05f);
        if (kind == 2) t = checks(12 * p.u, 6 * p.v, 0.06f);
        if (kind == 3) t = 0.5f + 0.3f * fractal_noise(160.0f * p.position, 2);
        if (kind == 4) t = smoothstep(-0.25f, 0.25f, std::sin(2 * kPi * (3 * p.u + 2 * p.v)));
        return Matter{mix(colour, second, t), {}};
    };
}

Paint book(Vec3 cover) {
    return [=](const SurfacePoint& p) {
        const bool pages = std::abs(p.normal.y) < 0.5f && p.v > 0.004f && p.v < 0.032f && p.normal.z > -0.5f;
        const float lines = 0.85f + 0.15f * stripes(p.v / 0.0035f, 0.5f, 0.2f);
        const float title = std::abs(p.normal.y) < 0.5f
                                ? stripes(p.u / 0.018f, 0.45f, 0.1f) * smoothstep(0.010f, 0.012f, p.v) *
                                      smoothstep(0.026f, 0.024f, p.v)
                                : 0;
        return Matter{
            pages ? lines * Vec3{0.75f, 0.70f, 0.58f} : mix(cover, {0.8f, 0.7f, 0.4f}, 0.7f * title), {}};
    };
}

void add_books(World& world, float x, float z) {
    const Vec3 covers[] = {{0.36f, 0.07f, 0.06f}, {0.08f, 0.20f, 0.16f}, {0.10f, 0.14f, 0.32f}};
    for (int i = 0; i < 3; ++i) {
        Mesh mesh = box({}, {0.12f - 0.012f * float(i), 0.018f, 0.085f}, 10);
        mesh.place(0.25f + 0.3f * float(i % 2), {x + 0.01f * float(i), 0.0185f + 0.0365f * float(i), z});
        world.add(std::move(mesh), book(covers[i]), Sides::Solid);
    }
}

struct Ball {
    float x = 0, z = 0, radius = 0;
    int kind = 0;
    Vec3 colour, second;
};

void build(World& world, float) {
    world.view = Viewpoint::looking({0, 0.26f, 0}, {0, 0.06f, 1.2f});
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.30f, 0.24f, 0.18f}, Vec3{0.42f, 0.44f, 0.5f}, 0.5f + 0.5f * d.y);
    };
    world.ambient_above = {1.1f, 1.1f, 1.1f}, world.ambient_below = {0.5f, 0.4f, 0.3f};
    world.lights.push_back({{-0.75f, 0.62f, 0.35f}, {1.6f, 1.45f, 1.2f}, 0.16f, true});
    const Vec3 orange{0.85f, 0.36f, 0.05f}, peel{0.70f, 0.24f, 0.02f}, cream{0.82f, 0.78f, 0.68f};
    const Vec3 red{0.62f, 0.06f, 0.05f}, teal{0.05f, 0.34f, 0.34f}, yellow{0.85f, 0.62f, 0.10f},
        ink{0.07f, 0.08f, 0.14f};
    const Ball balls[] = {
        {0.155f, 0.74f, 0.036f, 1, red, cream},      {-0.20f, 0.86f, 0.045f, 3, orange, peel},
        {0.03f, 1.20f, 0.052f, 2, cream, ink},       {0.235f, 1.14f, 0.034f, 4, teal, cream},
        {-0.155f, 1.32f, 0.040f, 0, yellow, yellow}, {0.30f, 1.60f, 0.060f, 3, orange, peel},
        {0.10f, 1.72f, 0.045f, 4, red, yellow},      {-0.52f, 2.05f, 0.055f, 1, teal, cream},
        {0.02f, 2.25f, 0.060f, 0, red, red},         {0.52f, 2.35f, 0.065f, 2, yellow, ink},
        {-0.20f, 2.55f, 0.055f, 3, orange, peel},    {-0.05f, 0.60f, 0.022f, 4, ink, yellow}};
    for (const Ball& b : balls)
        world.add(sphere({b.x, b.radius, b.z}, {b.radius, b.radius, b.radius}, 48, 24),
                  ball(b.kind, b.colour, b.second), Sides::Solid);
    add_books(world, -0.40f, 1.55f);
    world.add(patch({-1.6f, 0, 0.2f}, {3.2f, 0, 0}, {0, 0, kTableEnd - 0.2f}, 110, 90), cloth, Sides::Sheet);
    world.add(patch({-5, -2, kWall}, {10, 0, 0}, {0, 6, 0}, 20, 12), room, Sides::Sheet);
    world.add(
        patch({-5, -0.75f, 0}, {10, 0, 0}, {0, 0, kWall}, 20, 10),
        [](const SurfacePoint& p) {
            const Vec3 board{0.22f, 0.14f, 0.09f};
            return Matter{board * (0.75f + 0.25f * stripes(p.position.x / 0.14f, 0.95f, 0.03f)), {}};
        },
        Sides::Sheet);
}

}  // namespace

BuiltInScene table() {
    return {
        {.name = "table",
         .purpose =
             "a continuous table top through focus with balls on it: contact shadows, round silhouettes",
         .camera = {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.4, .focus_distance_m = 1.2}},
        build};
}

}  // namespace petzval::scene
