// Alpha cut-outs, as games and set extensions have them: flat cards from which leaves, trees and an iron gate
// are cut. An edge lies wherever the card's drawing says, at one depth per card.
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kFocus = 2.5f, kEyeHeight = 1.1f;

// The leaf that covers a place of a drawing of leaves, one around every lattice point; 0 is none.
float leaf_at(float x, float y, std::uint32_t seed) {
    const int i = int(std::floor(x)), j = int(std::floor(y));
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const auto random = [&](std::uint32_t what) { return cell_value(i + di, j + dj, seed + what); };
            const float turn = 2 * kPi * random(0), c = std::cos(turn), s = std::sin(turn);
            const float dx = x - float(i + di) - random(1), dy = y - float(j + dj) - random(2);
            const float along = (c * dx + s * dy) / 0.62f, across = (c * dy - s * dx) / 0.26f;
            if (along * along + std::abs(across) * (1 + 0.5f * along) < 0.75f)
                return 0.15f + 0.85f * random(3);
        }
    return 0;
}

Paint leafy(float per_u, float per_v, std::uint32_t seed, Vec3 dark, Vec3 bright) {
    return [=](const SurfacePoint& p) {
        return Matter{mix(dark, bright, leaf_at(per_u * p.u, per_v * p.v, seed)), {}};
    };
}

// Ivy on an invisible string, before the lens; trees behind.
void add_leaves(World& world) {
    const auto hanging = [&](Vec3 corner, float width, float height, std::uint32_t seed) {
        const float per_u = width / 0.032f, per_v = height / 0.032f;
        const Cutout cut = [=](float u, float v) {
            const float wide = 0.30f + 0.62f * v + 0.10f * std::sin(9 * v);  // it thins out downwards
            return std::abs(2 * u - 1) < wide && leaf_at(per_u * u, per_v * v, seed) > 0;
        };
        world.add(patch(corner, {width, 0, 0.05f}, {0, height, 0}, 6, 10),
                  leafy(per_u, per_v, seed, {0.05f, 0.12f, 0.03f}, {0.24f, 0.42f, 0.10f}), Sides::Leaf, cut);
    };
    hanging({-0.31f, kEyeHeight - 0.06f, 0.70f}, 0.17f, 0.26f, 741);
    hanging({0.16f, kEyeHeight + 0.00f, 0.80f}, 0.22f, 0.22f, 742);
    for (int i = 0; i < 9; ++i) {
        const float z = 5.5f + 1.3f * float(i), half = 1.0f + 0.10f * z;
        const float x = (i % 2 ? 1.0f : -1.0f) * (0.5f + 0.20f * z * cell_value(i, 0, 743) + 0.06f * z);
        const std::uint32_t seed = std::uint32_t(750 + i);
        const float per = 2 * half / 0.16f;
        const Cutout cut = [=](float u, float v) {
            const float dx = 2 * u - 1, dy = 2 * v - 1.05f;
            const bool trunk = std::abs(dx) < 0.05f && v < 0.5f;
            const float crown = dx * dx + 1.3f * dy * dy + 0.25f * noise({5 * u, 5 * v, float(i)});
            return trunk || (crown < 0.75f && leaf_at(per * u, per * v, seed) > 0);
        };
        world.add(patch({x - half, 0, z}, {2 * half, 0, 0}, {0, 2 * half, 0}, 8, 8),
                  leafy(per, per, seed, {0.07f, 0.10f, 0.03f}, {0.42f, 0.46f, 0.12f}), Sides::Leaf, cut);
    }
}

// Bars, rings between them and spear heads, cut from one sheet in focus.
void add_gate(World& world) {
    constexpr float kWidth = 2.2f, kHeight = 1.35f;
    const Cutout cut = [](float u, float v) {
        const float x = u * 16, y = v * kHeight / kWidth * 16, across = x - std::floor(x) - 0.5f;
        const float top = y - 8.6f;
        if (top > 0) return std::abs(across) < 0.20f * (1 - top / 1.1f);
        const bool rail =
            std::abs(y - 1.0f) < 0.10f || std::abs(y - 6.4f) < 0.10f || std::abs(y - 7.5f) < 0.10f;
        const float ring = std::hypot(x - std::round(x), y - 6.95f);
        return rail || std::abs(across) < 0.085f || (ring < 0.44f && ring > 0.34f);
    };
    world.add(
        patch({-0.5f * kWidth - 0.05f, 0.12f, kFocus}, {kWidth, 0, 0}, {0, kHeight, 0}, 10, 8),
        [](const SurfacePoint& p) {
            const float rust = smoothstep(0.0f, 0.6f, fractal_noise(14.0f * p.position, 2));
            return Matter{mix(Vec3{0.06f, 0.10f, 0.10f}, Vec3{0.34f, 0.16f, 0.07f}, rust), {}};
        },
        Sides::Leaf, cut);
}

void build(World& world, float) {
    world.view.position = {0, kEyeHeight, 0};
    world.sky = [](Vec3 d) {
        return mix(Vec3{1.0f, 1.0f, 0.95f}, Vec3{0.34f, 0.56f, 0.95f}, smoothstep(0, 0.4f, d.y));
    };
    world.ambient_above = {1.1f, 1.2f, 1.4f}, world.ambient_below = {0.5f, 0.45f, 0.35f};
    world.lights.push_back({{-0.5f, 0.8f, -0.35f}, {2.3f, 2.1f, 1.8f}, 0.02f, true});
    add_leaves(world);
    add_gate(world);
    world.add(
        patch({-20, 0, 0.8f}, {40, 0, 0}, {0, 0, 40}, 60, 60),
        [](const SurfacePoint& p) {
            const Vec3 q = p.position;
            const float path = smoothstep(0.75f, 0.65f, std::abs(q.x - 0.15f * std::sin(0.6f * q.z)));
            const float grit = 1 + 0.2f * fractal_noise(9.0f * q, 2);
            return Matter{grit * mix(Vec3{0.16f, 0.24f, 0.07f}, Vec3{0.56f, 0.50f, 0.40f}, path), {}};
        },
        Sides::Sheet);
    world.add(
        patch({-5, 0, 20}, {10, 0, 0}, {0, 5, 0}, 10, 6),
        [](const SurfacePoint& p) {
            const float pane = stripes(p.u * 7, 0.45f, 0.03f) * stripes(p.v * 3 - 0.3f, 0.5f, 0.03f);
            return Matter{mix(Vec3{0.70f, 0.54f, 0.40f}, Vec3{0.10f, 0.13f, 0.18f}, pane), {}};
        },
        Sides::Sheet);
}

}  // namespace

BuiltInScene cutouts() {
    return {{.name = "cutouts",
             .purpose = "flat cards with leaves, trees and a gate cut from them",
             .camera =
                 {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.8, .focus_distance_m = kFocus}},
            build};
}

}  // namespace petzval::scene
