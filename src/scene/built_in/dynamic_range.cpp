// A table by a window: a room at 500 lux that looks out on shade at 7 000 and sun at 70 000, with the sun
// glittering on water beyond. The steps are those of a bright day as M. Kawase lists them ("Renderist
// training course 2.0", CEDEC 2008): sun to shade 10 to 100, shade to room about 10. Exposed for the room,
// most of the view lies far above white, and the lens's picture of it depends on whether those values were
// kept.
#include "scene/built_in/plants.h"
#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kLux =
    1.0f / 450;  // irradiance in picture units: a white sheet at 450 lux has radiance 1 / pi
constexpr float kSun = 70000 * kLux, kSkylight = 7000 * kLux, kRoom = 500 * kLux;
constexpr float kEyeHeight = 1.22f, kTable = 0.97f, kFocus = 1.5f, kWindow = 3.2f, kGround = -0.4f;

Paint plain(Vec3 albedo) {
    return [=](const SurfacePoint&) { return Matter{albedo, {}}; };
}

void add_room(World& world) {
    const Paint plaster = [](const SurfacePoint& p) {
        return Matter{Vec3{0.66f, 0.60f, 0.52f} * (1 + 0.05f * fractal_noise(2.0f * p.position, 3)), {}};
    };
    const float wide = 2.3f, high = 2.7f, back = -1.6f, deep = kWindow - back;
    world.add(patch({-wide, 0, back}, {2 * wide, 0, 0}, {0, 0, deep}, 12, 12), plain({0.30f, 0.2f, 0.13f}),
              Sides::Sheet);
    world.add(patch({wide, high, back}, {-2 * wide, 0, 0}, {0, 0, deep}, 12, 12), plain({0.7f, 0.68f, 0.64f}),
              Sides::Sheet);
    world.add(patch({-wide, 0, back}, {0, 0, deep}, {0, high, 0}, 12, 8), plaster, Sides::Sheet);
    world.add(patch({wide, 0, kWindow}, {0, 0, -deep}, {0, high, 0}, 12, 8), plaster, Sides::Sheet);
    world.add(patch({wide, 0, back}, {-2 * wide, 0, 0}, {0, high, 0}, 8, 8), plaster, Sides::Sheet);
    // The wall around the window, as thick boxes, and its frame.
    const auto wall = [&](float x0, float x1, float y0, float y1) {
        world.add(box({0.5f * (x0 + x1), 0.5f * (y0 + y1), kWindow + 0.12f},
                      {0.5f * (x1 - x0), 0.5f * (y1 - y0), 0.12f}, 14),
                  plaster, Sides::Solid);
    };
    wall(-2.4f, -1.0f, 0, high), wall(1.0f, 2.4f, 0, high), wall(-1.0f, 1.0f, 0, 1.0f),
        wall(-1.0f, 1.0f, 2.3f, high);
    // The front of the house, seen by the sun alone.
    const auto front = [&](float x0, float x1, float y0, float y1) {
        world.add(patch({x0, y0, kWindow + 0.12f}, {x1 - x0, 0, 0}, {0, y1 - y0, 0}, 4, 4), plaster,
                  Sides::Sheet);
    };
    front(-40, -2.3f, kGround, 22), front(2.3f, 40, kGround, 22), front(-2.3f, 2.3f, high, 22);
    const auto bar = [&](Vec3 centre, Vec3 half) {
        world.add(box(centre, half, 8), plain({0.62f, 0.60f, 0.56f}), Sides::Solid);
    };
    for (const float x : {-0.975f, -0.33f, 0.33f, 0.975f})
        bar({x, 1.65f, kWindow + 0.05f}, {0.022f, 0.65f, 0.025f});
    for (const float y : {1.02f, 1.46f, 2.28f}) bar({0, y, kWindow + 0.05f}, {1.0f, 0.02f, 0.028f});
}

Matter boards(const SurfacePoint& p) {
    const float grain = noise({55 * p.position.x, 2, 4 * p.position.z}) +
                        0.5f * noise({140 * p.position.x, 7, 9 * p.position.z});
    return {Vec3{0.40f, 0.23f, 0.12f} * (1 + 0.22f * grain) *
                (0.55f + 0.45f * stripes(p.position.x / 0.16f, 0.975f, 0.012f)),
            {}};
}

void add_still_life(World& world) {
    world.add(box({0, kTable - 0.02f, 1.62f}, {0.95f, 0.02f, 0.55f}, 24), boards, Sides::Solid);
    const Vec3 jug_at{-0.24f, kTable, 1.52f};
    world.add(
        lathe(jug_at,
              {{0.002f, 0},
               {0.055f, 0.001f},
               {0.062f, 0.008f},
               {0.078f, 0.04f},
               {0.083f, 0.075f},
               {0.075f, 0.115f},
               {0.052f, 0.155f},
               {0.040f, 0.185f},
               {0.041f, 0.205f},
               {0.050f, 0.222f},
               {0.048f, 0.224f},
               {0.036f, 0.20f},
               {0.034f, 0.18f}},
              48),
        [](const SurfacePoint& p) {
            const float band = stripes(p.v * 4.1f + 0.1f, 0.12f, 0.03f);
            const float dot = stripes(p.u * 14, 0.5f, 0.06f) * stripes(p.v * 4.1f + 0.55f, 0.2f, 0.03f);
            return Matter{mix(Vec3{0.74f, 0.71f, 0.64f}, Vec3{0.06f, 0.14f, 0.36f}, std::max(band, dot)), {}};
        },
        Sides::Solid);
    const Foliage sprig{{0.16f, 0.11f, 0.06f}, {0.16f, 0.30f, 0.08f}, {0.34f, 0.44f, 0.14f}, 0.05f};
    add_twig(world, jug_at + Vec3{0, 0.19f, 0}, jug_at + Vec3{-0.17f, 0.42f, -0.05f}, 9, sprig, 5);
    add_twig(world, jug_at + Vec3{0.01f, 0.19f, 0}, jug_at + Vec3{0.14f, 0.46f, 0.06f}, 10, sprig, 6);
    const Vec3 cup_at{0.10f, kTable, 1.40f};
    world.add(lathe(cup_at,
                    {{0.002f, 0}, {0.072f, 0.001f}, {0.078f, 0.009f}, {0.07f, 0.011f}, {0.03f, 0.012f}}, 40),
              plain({0.72f, 0.70f, 0.66f}), Sides::Solid);
    world.add(
        lathe(cup_at,
              {{0.022f, 0.012f},
               {0.026f, 0.02f},
               {0.036f, 0.045f},
               {0.041f, 0.072f},
               {0.039f, 0.073f},
               {0.034f, 0.05f},
               {0.02f, 0.022f},
               {0.001f, 0.02f}},
              40),
        [](const SurfacePoint& p) {
            return Matter{
                mix(Vec3{0.74f, 0.72f, 0.68f}, Vec3{0.62f, 0.16f, 0.08f}, stripes(p.v * 2.6f, 0.14f, 0.03f)),
                {}};
        },
        Sides::Solid);
    for (int i = 0; i < 3; ++i) {
        const Vec3 at{0.30f + 0.085f * float(i % 2), kTable + 0.04f, 1.60f - 0.08f * float(i)};
        world.add(
            sphere(at, {0.041f, 0.039f, 0.041f}, 36, 20),
            [](const SurfacePoint& p) {
                return Matter{mix(Vec3{0.80f, 0.34f, 0.04f}, Vec3{0.66f, 0.24f, 0.02f},
                                  0.5f + 0.4f * noise(190.0f * p.position)),
                              {}};
            },
            Sides::Solid);
    }
}

// The house throws its shade over trees and lawn as far as the pond; beyond lies the sun.
void add_garden(World& world) {
    world.add(
        patch({-30, kGround, kWindow + 0.24f}, {60, 0, 0}, {0, 0, 60}, 30, 80),
        [](const SurfacePoint& p) {
            const float pond = smoothstep(
                1.05f, 0.98f, std::hypot((p.position.x - 0.6f) / 4.5f, (p.position.z - 28) / 5.0f));
            const Vec3 lawn = mix(Vec3{0.08f, 0.16f, 0.04f}, Vec3{0.20f, 0.25f, 0.07f},
                                  0.5f + 0.5f * fractal_noise(1.7f * p.position, 3));
            return Matter{mix(lawn, {0.03f, 0.05f, 0.07f}, pond), {}};
        },
        Sides::Sheet);
    world.add(
        box({-3.0f, 2.2f, 46}, {4.6f, 2.6f, 2}, 20),
        [](const SurfacePoint& p) {
            const float pane = stripes(p.u / 1.8f, 0.42f, 0.02f) * stripes(p.v / 2.4f - 0.35f, 0.5f, 0.02f);
            return Matter{mix(Vec3{0.74f, 0.72f, 0.66f}, Vec3{0.06f, 0.08f, 0.10f}, pane), {}};
        },
        Sides::Solid);
    const Paint foliage = [](const SurfacePoint& p) {
        const float tuft = smoothstep(-0.6f, 0.9f, fractal_noise(3.5f * p.position, 3));
        return Matter{mix(Vec3{0.03f, 0.07f, 0.02f}, Vec3{0.26f, 0.34f, 0.09f}, tuft), {}};
    };
    for (int i = 0; i < 22; ++i) {
        const auto random = [i](int what) { return cell_value(i, what, 77); };
        // Crowns to both sides of a view to the pond.
        const float z = 11 + 4 * random(0), size = 0.8f + 0.7f * random(1), y = 5.2f * random(2) - 0.2f;
        const float x = (i % 2 ? 1.0f : -1.0f) * (1.3f - 0.13f * y + 4.2f * random(3));
        world.add(sphere({x, y, z}, {size, 0.9f * size, size}, 28, 16), foliage, Sides::Solid);
    }
    for (int i = 0; i < 90; ++i) {  // the sun on the ripples of the pond
        const float z = 24 + 8.5f * cell_value(i, 0, 78), x = 0.6f + 3.2f * (2 * cell_value(i, 1, 78) - 1);
        const float strength = std::exp2(6 * cell_value(i, 2, 78));
        world.add_lamp({x, kGround + 0.01f, z}, 0.006f, 260 * strength * Vec3{1, 0.95f, 0.86f});
    }
    for (int i = 0; i < 110; ++i) {  // sky between the leaves
        const float z = 9.6f + 0.3f * cell_value(i, 0, 79), x = 3.6f * (2 * cell_value(i, 1, 79) - 1);
        const float y = 1.6f + 2.2f * cell_value(i, 2, 79), size = 0.008f + 0.035f * cell_value(i, 3, 79);
        world.add_lamp({x, y, z}, size, kSkylight / kPi * Vec3{1.3f, 1.35f, 1.4f});
    }
    const Foliage tree{{0.05f, 0.04f, 0.03f}, {0.10f, 0.19f, 0.04f}, {0.20f, 0.31f, 0.07f}, 0.13f};
    for (int i = 0; i < 5; ++i) {
        const float y = 1.75f + 0.13f * float(i);
        add_twig(world, {2.6f, y + 0.25f, 5.6f + 0.25f * float(i)},
                 {0.45f - 0.1f * float(i % 3), y, 5.4f + 0.3f * float(i)}, 15, tree, std::uint32_t(300 + i));
    }
}

void build(World& world, float) {
    world.view.position = {0, kEyeHeight, 0};
    world.sky = [](Vec3 d) {
        return kSkylight / kPi *
               mix(Vec3{1.35f, 1.35f, 1.3f}, Vec3{0.55f, 0.8f, 1.25f}, smoothstep(0, 0.7f, d.y));
    };
    world.ambient_above = 0.5f * kRoom * Vec3{1, 1, 1.05f};
    world.ambient_below = 0.2f * kRoom * Vec3{1, 0.9f, 0.8f};
    world.brightest_bounce = 1.2f;
    world.lights.push_back({{-0.55f, 0.45f, -0.7f}, kSun * Vec3{1, 0.94f, 0.84f}, 0.005f, true, false});
    world.lights.push_back(
        {{0, 1.65f, kWindow - 0.05f}, 2.4f * kRoom * Vec3{0.95f, 1, 1.08f}, 0.6f});  // the window
    world.lights.push_back(
        {{-0.9f, 2.3f, 0.2f}, 1.1f * kRoom * Vec3{1, 0.86f, 0.68f}, 0.3f});  // a lamp in the room
    add_room(world);
    add_still_life(world);
    add_garden(world);
}

}  // namespace

BuiltInScene dynamic_range() {
    return {
        {.name = "dynamic-range",
         .purpose = "a room at 500 lux in front of a garden at 7 000 to 70 000 lux: light far above white",
         .camera =
             {.focal_length_mm = 50, .sensor_width_mm = 36, .f_number = 1.4, .focus_distance_m = kFocus}},
        build};
}

}  // namespace petzval::scene
