// A street at dusk past a post: it stands wide and blurred before shop signs and lamps, wires run from it,
// and the ground recedes from before the lens to the houses. As the camera moves to the right, lamps slip
// behind the post and come out again; a crate, a ball and bollards in focus are cut by it.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

#include <array>

namespace petzval::scene {
namespace {

constexpr float kEyeHeight = 0.50f, kFocus = 4.0f, kPost = 0.80f, kFronts = 13;
constexpr float kBlurTangent = 0.5f * 0.075f / 1.2f;  // radius of the aperture, m

constexpr Vec3 kSodium{1, 0.52f, 0.16f}, kWarm{1, 0.74f, 0.44f}, kWhite{1, 0.92f, 0.80f},
    kCool{0.62f, 0.80f, 1};
constexpr Vec3 kRed{1, 0.07f, 0.04f}, kGreen{0.10f, 1, 0.45f}, kPink{1, 0.12f, 0.45f}, kCyan{0.08f, 0.70f, 1};

Paint plain(Vec3 albedo) {
    return [=](const SurfacePoint&) { return Matter{albedo, {}}; };
}

// Zinc with stickers on it.
Matter post_paint(const SurfacePoint& p) {
    const float around = std::atan2(p.normal.x, -p.normal.z), up = p.position.y;
    const float streak = 0.8f + 0.35f * noise({26 * around, 4 * up, 3});
    Vec3 colour = streak * Vec3{0.20f, 0.21f, 0.21f};
    const int row = int(std::floor(up / 0.115f));
    const float v = up / 0.115f - float(row), turn = 1.6f * cell_value(row, 0, 501) - 0.8f;
    const float u = (around - turn) / 0.55f;
    const float paper =
        smoothstep(1.0f, 0.96f, std::abs(u)) * smoothstep(0.08f, 0.12f, v) * smoothstep(0.95f, 0.90f, v);
    const Vec3 sheet{0.3f + 0.55f * cell_value(row, 1, 501), 0.3f + 0.5f * cell_value(row, 2, 501),
                     0.25f + 0.5f * cell_value(row, 3, 501)};
    const float print = stripes(7 * v, 0.5f, 0.1f) * smoothstep(0.8f, 0.7f, std::abs(u));
    return {mix(colour, sheet * (1 - 0.7f * print), paper), {}};
}

void add_post(World& world) {
    Tubes post, wires;
    const float x = 0.145f;
    post.path({{x, 0, kPost}, {x, 1.4f, kPost}}, 0.041f, 0.041f);
    wires.line({x - 0.02f, 0.66f, kPost}, {-0.55f, 0.42f, 1.45f}, 0.0045f);  // stays and a cable
    wires.line({x + 0.02f, 0.62f, kPost}, {0.9f, 0.22f, 1.30f}, 0.0045f);
    wires.curve({{-1.0f, 0.63f, 1.25f}, {-0.4f, 0.565f, 1.12f}, {x, 0.58f, kPost}}, 12, 0.0028f, 0.0028f);
    wires.curve({{x, 0.58f, kPost}, {0.6f, 0.56f, 1.0f}, {1.3f, 0.66f, 1.3f}}, 12, 0.0028f, 0.0028f);
    world.add(std::move(post), post_paint);
    world.add(std::move(wires), plain({0.05f, 0.05f, 0.055f}));
}

Vec3 wood(Vec3 p, Vec3 base) {
    const float grain = noise({3 * p.x, 50 * p.y, 50 * p.z}) + 0.6f * noise({8 * p.x, 120 * p.y, 120 * p.z});
    return base * (1 + 0.28f * grain);
}

Matter crate(const SurfacePoint& p) {
    const float slat = stripes(p.v / 0.078f, 0.86f, 0.04f);
    const float corner = smoothstep(0.032f, 0.028f, std::min(p.u, std::abs(0.44f - p.u)));
    const float mark = smoothstep(0.072f, 0.068f, std::hypot(p.u - 0.22f, p.v - 0.16f)) *
                       smoothstep(0.046f, 0.050f, std::hypot(p.u - 0.22f, p.v - 0.16f));
    const Vec3 base = mix(wood(p.position, {0.56f, 0.42f, 0.25f}), {0.42f, 0.09f, 0.06f}, 0.8f * mark);
    return {mix(Vec3{0.05f, 0.035f, 0.025f}, base, std::max(slat, corner)), {}};
}

Matter football(const SurfacePoint& p) {
    const float patch = checks(8 * p.u, 5 * p.v, 0.06f) * (1 + 0.08f * noise(150.0f * p.position));
    return {mix(Vec3{0.72f, 0.70f, 0.66f}, Vec3{0.06f, 0.06f, 0.07f}, patch), {}};
}

void add_things_in_focus(World& world) {
    Mesh wooden = box({}, {0.22f, 0.17f, 0.18f}, 14);
    wooden.place(0.35f, {-0.22f, 0.17f, kFocus + 0.18f});
    world.add(std::move(wooden), crate, Sides::Solid);
    world.add(sphere({0.36f, 0.115f, kFocus}, {0.115f, 0.115f, 0.115f}, 64, 32), football, Sides::Solid);
    Tubes iron;
    float previous = 0;
    for (int i = 0; i < 5; ++i) {
        const float x = -1.25f + 0.72f * float(i), z = kFocus + 0.35f + 0.12f * float(i);
        iron.path({{x, 0, z}, {x, 0.1f, z}, {x, 0.52f, z}, {x, 0.57f, z}}, 0.045f, 0.034f);
        iron.line({x, 0.61f, z}, {x, 0.615f, z}, 0.042f);
        if (i > 0) {
            std::vector<Vec3> chain;
            for (int k = 0; k <= 20; ++k) {
                const float t = float(k) / 20;
                chain.push_back({mix(previous, x, t), 0.53f - 0.7f * t * (1 - t), z - 0.12f * (1 - t)});
            }
            iron.path(chain, 0.009f, 0.009f);
        }
        previous = x;
    }
    world.add(std::move(iron), [](const SurfacePoint& p) {
        const float band = stripes(p.position.y / 0.21f - 0.2f, 0.45f, 0.03f);
        return Matter{mix(Vec3{0.10f, 0.10f, 0.11f}, Vec3{0.62f, 0.12f, 0.08f}, band), {}};
    });
}

Matter ground(const SurfacePoint& p) {
    const Vec3 q = p.position;
    const Brick sett = brick(q.x / 0.15f, q.z / 0.11f, 0.12f, 0.14f);
    const float fade = smoothstep(16, 7, q.z), joint = sett.mortar * fade;
    const float tint = 0.7f + 0.6f * cell_value(sett.column, sett.row, 511);
    const float line = smoothstep(0.075f, 0.065f, std::abs(q.x + 1.05f - 0.02f * q.z)) +
                       smoothstep(0.055f, 0.045f, std::abs(q.z - 2.1f + 0.05f * q.x));
    const float worn = smoothstep(-0.6f, 0.1f, fractal_noise(5.0f * q, 2));
    const float grit = 1 + 0.16f * noise(60.0f * q);
    const Vec3 stone =
        grit * tint *
        mix(Vec3{0.16f, 0.15f, 0.15f}, Vec3{0.20f, 0.17f, 0.14f}, 0.5f + 0.5f * fractal_noise(0.7f * q, 2));
    return {mix(stone * (1 - 0.6f * joint), Vec3{0.60f, 0.56f, 0.46f}, 0.8f * worn * std::min(1.0f, line)),
            {}};
}

// Letters of a script nobody reads: 0…1 how much of them lies at (x, y), one letter to a unit.
float letters(float x, float y, std::uint32_t seed) {
    const int i = int(std::floor(x));
    const float u = x - float(i);
    if (y < 0 || y > 1 || u < 0.12f || u > 0.88f) return 0;
    const int column = int((u - 0.12f) / 0.76f * 3), row = int(y * 5);
    const bool stem = column == int(2.99f * cell_value(i, 0, seed)),
               bar = row == int(4.99f * cell_value(i, 1, seed));
    return stem || bar || cell_value(3 * i + column, row, seed + 1) > 0.68f ? 1.0f : 0.0f;
}

struct Sign {
    Vec3 corner;
    float width = 0, height = 0;
    Vec3 back, front;
    int count = 0;  // of letters
};

void add_signs(World& world) {
    const Sign signs[] = {
        {{-2.45f, 1.30f, 10.5f}, 1.7f, 0.36f, 0.4f * kRed, 3.0f * kWarm, 7},
        {{-0.45f, 1.42f, 11.5f}, 1.6f, 0.44f, 1.5f * kWarm, 0.1f * kRed, 6},
        {{1.35f, 1.00f, 9.5f}, 1.5f, 0.32f, 0.2f * kCyan, 3.0f * kCyan, 7},
        {{0.62f, 0.62f, 7.6f}, 0.32f, 0.75f, 0.25f * kPink, 3.2f * kPink, 2},
        {{-1.62f, 0.50f, 7.2f}, 0.32f, 0.80f, 0.2f * kGreen, 2.4f * kGreen, 2},
    };
    std::uint32_t seed = 521;
    for (const Sign& sign : signs) {
        ++seed;
        const float lines = sign.height > sign.width ? 5.0f : 1.0f;
        world.add(
            patch(sign.corner, {sign.width, 0, 0}, {0, sign.height, 0}, 2, 2),
            [=](const SurfacePoint& p) {
                const float line = lines * p.v;
                const float ink = letters(float(sign.count) * p.u + 20 * std::floor(line),
                                          (line - std::floor(line) - 0.18f) / 0.64f, seed);
                const float rim = smoothstep(0.02f, 0.03f, std::min({p.u, 1 - p.u, p.v, 1 - p.v}));
                return Matter{{0.1f, 0.1f, 0.1f}, rim * mix(sign.back, sign.front, ink)};
            },
            Sides::Sheet);
    }
}

// A lamp that fills its disc, once out of focus, with about `glow`.
void lamp(World& world, Vec3 at, float radius_m, Vec3 colour, float glow) {
    const float own = radius_m / at.z, blur = kBlurTangent * std::abs(1 / kFocus - 1 / at.z);
    world.add_lamp(at, radius_m, glow * std::max(1.0f, blur * blur / (own * own)) * colour);
}

void add_lamps(World& world) {
    Tubes masts;
    for (int i = 0; i < 4; ++i)
        for (const float side : {-1.0f, 1.0f}) {
            const float z = 7.5f + 1.9f * float(i), x = side * (0.85f + 0.30f * float(i)) + 0.15f;
            const float y = 1.36f + 0.13f * float(i);
            lamp(world, {x, y, z}, 0.028f, side < 0 ? kSodium : kWarm, 2.6f);
            masts.path({{x, 0, z + 0.05f}, {x, y - 0.05f, z + 0.05f}}, 0.035f, 0.022f);
        }
    for (int i = 0; i < 26; ++i) {  // a string of bulbs across the street
        const float t = float(i) / 25;
        const Vec3 at{mix(-1.9f, 2.2f, t), 1.35f - 1.1f * t * (1 - t), mix(7.0f, 8.6f, t)};
        lamp(world, at, 0.010f, i % 4 == 2 ? kCool : kWarm, 1.0f + 0.9f * cell_value(i, 0, 541));
    }
    for (int i = 0; i < 5; ++i) {  // cars
        const float x = -1.4f + 0.75f * float(i), z = 9 + 1.4f * cell_value(i, 1, 541);
        for (const float half : {-0.28f, 0.28f})
            lamp(world, {x + half, 0.42f, z}, 0.022f, i % 2 ? kRed : kWhite, i % 2 ? 1.6f : 3.0f);
    }
    world.add(std::move(masts), plain({0.05f, 0.06f, 0.055f}));
}

Matter fronts(const SurfacePoint& p) {
    const float x = p.position.x / 1.25f, y = p.position.y / 1.35f;
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const float u = x - float(i), v = y - float(j);
    const float pane = smoothstep(0.20f, 0.22f, u) * smoothstep(0.80f, 0.78f, u) *
                       smoothstep(0.20f, 0.22f, v) * smoothstep(0.86f, 0.84f, v) *
                       (1 - smoothstep(0.02f, 0.01f, std::abs(u - 0.5f)));
    const float strength = std::max(0.0f, 2.6f * cell_value(i, j, 551) - 1.2f);
    const Vec3 light = strength * mix(kWarm, kCool, smoothstep(0.7f, 0.8f, cell_value(j, i, 552)));
    const Brick b = brick(p.position.x / 0.26f, p.position.y / 0.09f, 0.06f, 0.16f);
    const Vec3 wall = mix(Vec3{0.30f, 0.13f, 0.09f}, Vec3{0.22f, 0.20f, 0.18f}, b.mortar) *
                      (0.7f + 0.5f * cell_value(b.column, b.row, 553));
    return {mix(wall, Vec3{0.03f, 0.04f, 0.05f}, pane), pane * (Vec3{0.01f, 0.014f, 0.024f} + light)};
}

void build(World& world, float time) {
    world.view.position = {0.17f * time, kEyeHeight, 0};
    world.sky = [](Vec3 d) {
        return mix(Vec3{0.34f, 0.22f, 0.20f}, Vec3{0.05f, 0.09f, 0.20f}, smoothstep(0, 0.35f, d.y));
    };
    world.ambient_above = {0.40f, 0.44f, 0.58f}, world.ambient_below = {0.26f, 0.22f, 0.18f};
    world.lights.push_back({{-1.6f, 2.6f, 2.4f}, {22, 17, 12}, 0.15f});  // the lamp above us
    world.lights.push_back({{2.6f, 1.7f, 4.0f}, {14, 8, 11}, 0.2f});     // a shop to the right
    world.lights.push_back({{-2.8f, 1.8f, 6.5f}, {14, 10, 6}, 0.2f});
    world.lights.push_back({{1.0f, 2.4f, 9.5f}, {20, 15, 10}, 0.2f});
    world.add(patch({-12, 0, 0.5f}, {24, 0, 0}, {0, 0, 14}, 60, 70), ground, Sides::Sheet);
    world.add(patch({-12, 0, kFronts}, {24, 0, 0}, {0, 5.6f, 0}, 40, 12), fronts, Sides::Sheet);
    add_things_in_focus(world);
    add_signs(world);
    add_lamps(world);
    add_post(world);
}

}  // namespace

BuiltInScene post() {
    return {{.name = "post",
             .purpose = "a wide post and wires near the lens; lamps and lit signs that move behind the post",
             .camera =
                 {.focal_length_mm = 75, .sensor_width_mm = 36, .f_number = 1.2, .focus_distance_m = kFocus},
             .frames = 48,
             .floor_m = 0},
            build};
}

}  // namespace petzval::scene
