#include "scene/built_in/park.h"

#include "scene/built_in/plants.h"
#include "scene/textures.h"

#include <array>

namespace petzval::scene {
namespace {

Paint plain(Vec3 albedo) {
    return [=](const SurfacePoint&) { return Matter{albedo, {}}; };
}

Matter lawn_and_path(const SurfacePoint& p) {
    const Vec3 q = p.position;
    const float grit = 1 + 0.12f * noise(30.0f * q) + 0.2f * fractal_noise(0.9f * q, 3);
    const float across = q.x - 0.9f - 0.05f * (q.z - 6) * std::sin(0.15f * q.z);
    const float path = smoothstep(1.3f, 1.2f, std::abs(across));
    // The sun comes through the crowns in spots.
    const float dapple = smoothstep(-0.1f, 0.25f, fractal_noise({0.8f * q.x, 3, 0.5f * q.z}, 2));
    const Vec3 grass =
        mix(Vec3{0.10f, 0.20f, 0.04f}, Vec3{0.26f, 0.32f, 0.08f}, 0.5f + 0.5f * fractal_noise(2.2f * q, 2));
    return {grit * (0.45f + 0.75f * dapple) * mix(grass, Vec3{0.58f, 0.50f, 0.40f}, path), {}};
}

// A crown: dark and bright leaves.
Matter leaves(const SurfacePoint& p) {
    const float tuft = smoothstep(-0.7f, 0.7f, fractal_noise(7.5f * p.position, 3));
    const float gold = smoothstep(0.1f, 0.5f, noise(0.6f * p.position));
    const Vec3 lit = mix(Vec3{0.36f, 0.46f, 0.10f}, Vec3{0.72f, 0.46f, 0.08f}, gold);
    return {mix(Vec3{0.06f, 0.11f, 0.03f}, lit, tuft), {}};
}

void add_trees(World& world) {
    Tubes trunks;
    for (int i = 0; i < 9; ++i) {
        const auto random = [i](int what) { return cell_value(i, what, 301); };
        const float side = i % 2 ? 1.0f : -1.0f, z = 8.5f + 2.6f * float(i / 2) + random(0);
        const float x = side * (1.6f + 0.13f * z + 1.2f * random(1)) - 0.5f;
        trunks.path({{x, 0, z}, {x + 0.1f * random(2), 1.4f, z}, {x + 0.3f * random(3), 3.6f, z}}, 0.19f,
                    0.12f);
        for (int k = 0; k < 5; ++k) {
            const auto other = [&](int what) { return cell_value(9 * i + k, what, 302); };
            const float size = 0.75f + 0.6f * other(0);
            const Vec3 at{x + 2.4f * (other(1) - 0.5f), 2.5f + 1.7f * other(2), z + 1.6f * (other(3) - 0.5f)};
            world.add(bush(at, {size, 0.7f * size, size}, 0.34f), leaves, Sides::Solid);
        }
    }
    world.add(std::move(trunks), [](const SurfacePoint& p) {
        const float bark = 0.7f + 0.5f * noise({18 * p.position.x, 4 * p.position.y, 18 * p.position.z});
        return Matter{bark * Vec3{0.16f, 0.12f, 0.09f}, {}};
    });
    for (int i = 0; i < 16; ++i) {  // bushes, and the far edge of the park
        const auto random = [i](int what) { return cell_value(i, what, 303); };
        const float z = 22 + 9 * random(0), size = 1.6f + 1.3f * random(1);
        const float x = (i % 2 ? 1.0f : -1.0f) * (1.8f + 9 * random(2));
        world.add(bush({x, 0.8f * size, z}, {size, 1.3f * size, size}, 0.3f), leaves, Sides::Solid);
    }
}

// A kiosk with goods on its shelves under a striped awning.
void add_kiosk(World& world) {
    constexpr float kX = -2.15f, kZ = 9.2f;
    world.add(
        box({kX, 1.25f, kZ + 0.6f}, {0.95f, 1.25f, 0.5f}, 12),
        [](const SurfacePoint& p) {
            if (p.normal.z > -0.5f || p.position.y < 0.9f || p.position.y > 2.0f)
                return Matter{{0.14f, 0.26f, 0.24f}, {}};
            const float x = (p.position.x - kX) / 0.11f, y = (p.position.y - 0.9f) / 0.27f;
            const int i = int(std::floor(x)), j = int(std::floor(y));
            const float fx = x - float(i), fy = y - float(j), tall = 0.45f + 0.4f * cell_value(i, j, 311);
            const float thing = smoothstep(0.14f, 0.2f, fx) * smoothstep(0.86f, 0.8f, fx) *
                                smoothstep(tall, tall - 0.06f, fy);
            const Vec3 colour{0.15f + 0.8f * cell_value(i, j, 312), 0.1f + 0.7f * cell_value(i, j, 313),
                              0.1f + 0.6f * cell_value(i, j, 314)};
            return Matter{mix(Vec3{0.05f, 0.04f, 0.04f}, colour, thing), 0.5f * thing * colour};
        },
        Sides::Solid);
    world.add(
        patch({kX - 1.1f, 2.05f, kZ - 0.75f}, {2.2f, 0, 0}, {0, 0.45f, 0.85f}, 16, 8),
        [](const SurfacePoint& p) {
            return Matter{
                mix(Vec3{0.80f, 0.76f, 0.68f}, Vec3{0.66f, 0.07f, 0.06f}, stripes(9 * p.u, 0.5f, 0.05f)), {}};
        },
        Sides::Leaf);
}

// Small flags on strings from tree to tree.
void add_bunting(World& world) {
    static const Vec3 kFlags[] = {{0.80f, 0.16f, 0.10f},
                                  {0.85f, 0.66f, 0.12f},
                                  {0.10f, 0.34f, 0.60f},
                                  {0.82f, 0.80f, 0.74f},
                                  {0.12f, 0.44f, 0.26f}};
    const Vec3 ends[][2] = {{{-3.2f, 2.55f, 8.4f}, {1.5f, 2.75f, 7.6f}},
                            {{-1.2f, 2.5f, 13}, {4.0f, 2.9f, 11}}};
    Tubes string;
    std::array<Mesh, 5> flags;
    for (const auto& [from, to] : ends) {
        constexpr int kCount = 26;
        const auto hung = [from = from, to = to](float t) {
            return mix(from, to, t) - Vec3{0, 4 * 0.42f * t * (1 - t), 0};
        };
        for (int i = 0; i < kCount; ++i) {
            const float t = float(i) / kCount, dt = 0.7f / kCount;
            const Vec3 a = hung(t), b = hung(t + dt), tip = 0.5f * (a + b) - Vec3{0, 0.17f, 0.02f};
            string.line(a, hung(t + 1.0f / kCount), 0.004f);
            Mesh flag;
            flag.positions = {a, b, tip};
            flag.normals.assign(3, {0, 0, -1});
            flag.uv.assign(3, {});
            flag.triangles = {{0, 1, 2}};
            flags[std::size_t(i % 5)].append(flag);
        }
    }
    world.add(std::move(string), plain({0.5f, 0.48f, 0.45f}));
    for (std::size_t i = 0; i < flags.size(); ++i)
        world.add(std::move(flags[i]), plain(kFlags[i]), Sides::Leaf);
}

// Sun on leaves and on the dew: points that become discs.
void add_glints(World& world) {
    for (int i = 0; i < 70; ++i) {
        const auto random = [i](int what) { return cell_value(i, what, 321); };
        const float z = 7.2f + 9 * random(0), x = 0.24f * z * (2 * random(1) - 1);
        const float y = 1.5f + z * (0.13f * (2 * random(2) - 1) + 0.03f), strength = std::exp2(4 * random(3));
        if (y < 0.05f) continue;
        world.add_lamp({x, y, z}, 0.006f, 55 * strength * Vec3{1, 0.93f, 0.74f});
    }
}

}  // namespace

void add_park(World& world) {
    world.sky = [](Vec3 d) {
        const Vec3 q = d / std::max(d.z, 0.1f);
        const float cloud = smoothstep(-0.2f, 0.6f, fractal_noise({7 * q.x, 11 * q.y, 2}, 3));
        return mix(mix(Vec3{1.5f, 1.5f, 1.4f}, Vec3{0.45f, 0.75f, 1.35f}, smoothstep(0, 0.35f, d.y)),
                   Vec3{2.1f, 2.05f, 1.95f}, cloud);
    };
    world.add(patch({-25, 0, 1}, {50, 0, 0}, {0, 0, 60}, 30, 40), lawn_and_path, Sides::Sheet);
    world.add(
        patch({-16, 0, 38}, {32, 0, 0}, {0, 7.5f, 0}, 24, 10),
        [](const SurfacePoint& p) {
            const float window = stripes(p.position.x / 1.9f, 0.42f, 0.02f) *
                                 stripes(p.position.y / 2.3f - 0.35f, 0.55f, 0.02f);
            return Matter{mix(Vec3{0.76f, 0.62f, 0.44f}, Vec3{0.10f, 0.13f, 0.17f}, window), {}};
        },
        Sides::Sheet);
    add_trees(world);
    add_kiosk(world);
    add_bunting(world);
    add_glints(world);
}

}  // namespace petzval::scene
