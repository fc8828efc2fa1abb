#include "scene/built_in/bicycle.h"

#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr float kWheelbase = 1.04f, kWheelRadius = 0.34f;  // m

Paint plain(Vec3 albedo) {
    return [=](const SurfacePoint&) { return Matter{albedo, {}}; };
}

struct Parts {
    Tubes frame, tyres, metal, leather, wicker;
};

// Straight and bent tubes through points of the stand: ahead, above, aside.
void bend(Tubes& tubes, const Stand& s, std::initializer_list<Vec3> points, float first_radius,
          float last_radius) {
    std::vector<Vec3> through;
    for (const Vec3& p : points) through.push_back(s.at(p.x, p.y, p.z));
    tubes.curve(through, through.size() > 2 ? 6 : 1, first_radius, last_radius);
}

void add_wheel(Parts& parts, const Stand& s, float ahead) {
    const Vec3 hub = s.at(ahead, kWheelRadius), up{0, 1, 0};
    parts.tyres.arc(hub, s.forward, up, kWheelRadius - 0.018f, 0, 2 * kPi, 96, 0.018f);
    parts.metal.arc(hub, s.forward, up, kWheelRadius - 0.042f, 0, 2 * kPi, 96, 0.008f);
    bend(parts.metal, s, {{ahead, kWheelRadius, -0.05f}, {ahead, kWheelRadius, 0.05f}}, 0.017f, 0.017f);
    for (int i = 0; i < 32; ++i) {
        // Spokes leave the hub's flange off the radius and alternate between its two sides.
        const float side = i % 2 == 0 ? 0.026f : -0.026f, angle = 2 * kPi * float(i) / 32;
        const float flange = angle + (i % 4 < 2 ? 1.1f : -1.1f);
        const auto point = [&](float a, float radius, float aside) {
            return s.at(ahead + radius * std::cos(a), kWheelRadius + radius * std::sin(a), aside);
        };
        parts.metal.line(point(flange, 0.02f, side), point(angle, kWheelRadius - 0.045f, 0), 0.0011f);
    }
    // Mudguard and its stays.
    const bool rear = ahead == 0;
    parts.frame.arc(hub, s.forward, up, kWheelRadius + 0.028f, rear ? 0.25f : 0.35f, rear ? 3.4f : 2.75f, 40,
                    0.013f);
    for (const float aside : {-0.05f, 0.05f})
        bend(parts.metal, s,
             {{ahead, kWheelRadius, aside}, {ahead - 0.3f, kWheelRadius + 0.2f, aside * 0.4f}}, 0.003f,
             0.003f);
}

void add_frame(Parts& parts, const Stand& s) {
    const float front = kWheelbase;
    Tubes& f = parts.frame;
    bend(f, s, {{0.44f, 0.29f}, {0.29f, 0.80f}}, 0.017f, 0.017f);                  // seat tube
    bend(f, s, {{0.44f, 0.29f}, {0.66f, 0.40f}, {0.83f, 0.64f}}, 0.019f, 0.019f);  // down tube
    bend(f, s, {{0.33f, 0.62f}, {0.55f, 0.60f}, {0.72f, 0.70f}, {0.80f, 0.80f}}, 0.015f, 0.015f);  // top tube
    bend(f, s, {{0.84f, 0.60f}, {0.785f, 0.86f}}, 0.022f, 0.022f);  // head tube
    for (const float aside : {-0.055f, 0.055f}) {
        bend(f, s, {{0, kWheelRadius, aside}, {0.44f, 0.29f, aside * 0.5f}}, 0.009f, 0.011f);  // chain stay
        bend(f, s, {{0, kWheelRadius, aside}, {0.31f, 0.74f, aside * 0.4f}}, 0.007f, 0.009f);  // seat stay
        bend(f, s, {{0.845f, 0.60f, aside}, {0.89f, 0.47f, aside}, {front, kWheelRadius, aside}}, 0.013f,
             0.008f);
        // Carrier over the rear wheel.
        bend(parts.metal, s, {{0.27f, 0.74f, aside}, {-0.28f, 0.74f, aside}}, 0.005f, 0.005f);
        bend(parts.metal, s, {{-0.2f, 0.74f, aside}, {0, kWheelRadius, aside}}, 0.004f, 0.004f);
    }
    for (int i = 0; i < 5; ++i)
        bend(parts.metal, s,
             {{-0.27f + 0.12f * float(i), 0.74f, -0.055f}, {-0.27f + 0.12f * float(i), 0.74f, 0.055f}},
             0.004f, 0.004f);
    bend(parts.metal, s, {{0.29f, 0.80f}, {0.262f, 0.90f}}, 0.012f, 0.012f);                    // seat post
    bend(parts.metal, s, {{0.785f, 0.86f}, {0.765f, 0.95f}, {0.80f, 0.985f}}, 0.012f, 0.012f);  // stem
}

void add_handlebar_and_cranks(Parts& parts, const Stand& s) {
    for (const float side : {-1.0f, 1.0f}) {
        bend(parts.metal, s,
             {{0.80f, 0.985f, 0},
              {0.84f, 0.995f, side * 0.08f},
              {0.84f, 1.02f, side * 0.18f},
              {0.78f, 1.045f, side * 0.26f},
              {0.66f, 1.05f, side * 0.29f}},
             0.011f, 0.011f);
        bend(parts.leather, s, {{0.66f, 1.05f, side * 0.29f}, {0.545f, 1.04f, side * 0.30f}}, 0.016f, 0.016f);
        bend(parts.metal, s, {{0.77f, 1.035f, side * 0.255f}, {0.64f, 1.01f, side * 0.265f}}, 0.004f,
             0.004f);  // brake
        const float turn = side * 0.17f;
        bend(parts.metal, s,
             {{0.44f, 0.29f, side * 0.07f}, {0.44f + turn * 0.55f, 0.29f - turn * 0.8f, side * 0.085f}},
             0.009f, 0.007f);
        bend(parts.tyres, s,
             {{0.44f + turn * 0.55f, 0.29f - turn * 0.8f, side * 0.09f},
              {0.44f + turn * 0.55f, 0.29f - turn * 0.8f, side * 0.18f}},
             0.014f, 0.014f);
    }
    const Vec3 axle = s.at(0.44f, 0.29f, -0.05f);
    parts.metal.arc(axle, s.forward, {0, 1, 0}, 0.085f, 0, 2 * kPi, 40, 0.004f);
    for (int i = 0; i < 5; ++i) {
        const float a = 2 * kPi * float(i) / 5;
        parts.metal.line(axle, axle + 0.085f * (std::cos(a) * s.forward + std::sin(a) * Vec3{0, 1, 0}),
                         0.004f);
    }
    bend(parts.tyres, s, {{0.44f, 0.375f, -0.05f}, {0, 0.385f, -0.05f}}, 0.003f, 0.003f);  // chain
    bend(parts.tyres, s, {{0.44f, 0.205f, -0.05f}, {0, 0.3f, -0.05f}}, 0.003f, 0.003f);
    // Bell.
    bend(parts.metal, s, {{0.82f, 1.03f, 0.14f}, {0.82f, 1.05f, 0.14f}}, 0.022f, 0.016f);
}

// An open basket in front of the handlebar: rings that widen upwards, and ribs.
void add_basket(Parts& parts, const Stand& s) {
    constexpr float kBottom = 0.79f, kTop = 0.985f, kAhead = 1.01f;
    const auto corner = [&](float above, float turn) {
        const float t = (above - kBottom) / (kTop - kBottom), wide = mix(0.10f, 0.14f, t),
                    deep = mix(0.15f, 0.19f, t);
        // A rounded rectangle.
        const float c = std::cos(turn), n = std::sin(turn);
        const auto squared = [](float x) { return std::copysign(std::sqrt(std::abs(x)), x); };
        return s.at(kAhead + wide * squared(c), above, deep * squared(n));
    };
    constexpr int kAround = 40, kRings = 9;
    for (int ring = 0; ring < kRings; ++ring) {
        const float above = mix(kBottom, kTop, float(ring) / (kRings - 1));
        std::vector<Vec3> around;
        for (int i = 0; i <= kAround; ++i) around.push_back(corner(above, 2 * kPi * float(i) / kAround));
        const float radius = ring == kRings - 1 ? 0.009f : 0.0045f;
        parts.wicker.path(around, radius, radius);
    }
    for (int i = 0; i < kAround; ++i) {
        const float turn = 2 * kPi * float(i) / kAround;
        parts.wicker.line(corner(kBottom, turn), corner(kTop, turn), 0.0035f);
    }
}

void add_flowers(World& world, const Stand& s) {
    static const Vec3 kPetals[] = {
        {0.85f, 0.80f, 0.72f}, {0.80f, 0.25f, 0.32f}, {0.85f, 0.55f, 0.12f}, {0.55f, 0.30f, 0.62f}};
    Tubes stems;
    for (int i = 0; i < 22; ++i) {
        const float ahead = 1.01f + 0.20f * (cell_value(i, 0, 71) - 0.5f),
                    aside = 0.30f * (cell_value(i, 1, 71) - 0.5f);
        const float above = 1.0f + 0.13f * cell_value(i, 2, 71),
                    size = 0.016f + 0.016f * cell_value(i, 3, 71);
        const Vec3 head = s.at(ahead, above, aside);
        stems.line(s.at(mix(1.01f, ahead, 0.4f), 0.9f, 0.4f * aside), head, 0.003f);
        if (i % 4 == 3) {  // a leaf
            Mesh leaf = sphere(head, {0.012f, 2.2f * size, 0.006f}, 12, 10);
            world.add(std::move(leaf), plain({0.10f, 0.24f, 0.07f}), Sides::Solid);
            continue;
        }
        const Vec3 petal = kPetals[i * 7 % 4];
        Mesh flower = sphere(head, {size, 0.75f * size, size}, 20, 12);
        world.add(
            std::move(flower),
            [=](const SurfacePoint& p) {
                const float folds = 0.72f + 0.28f * std::cos(2 * kPi * 7 * p.u + 5 * p.v);
                return Matter{petal * (folds * (0.55f + 0.45f * p.v)), {}};
            },
            Sides::Solid);
    }
    world.add(std::move(stems), plain({0.08f, 0.20f, 0.06f}));
}

}  // namespace

void add_bicycle(World& world, const Stand& stand) {
    Parts parts;
    add_wheel(parts, stand, 0);
    add_wheel(parts, stand, kWheelbase);
    add_frame(parts, stand);
    add_handlebar_and_cranks(parts, stand);
    add_basket(parts, stand);
    world.add(std::move(parts.frame), plain({0.05f, 0.30f, 0.30f}));
    world.add(std::move(parts.tyres), plain({0.035f, 0.035f, 0.04f}));
    world.add(std::move(parts.metal), plain({0.55f, 0.55f, 0.57f}));
    world.add(std::move(parts.leather), plain({0.30f, 0.13f, 0.06f}));
    world.add(std::move(parts.wicker), plain({0.46f, 0.29f, 0.13f}));
    Mesh saddle = sphere({}, {0.135f, 0.032f, 0.085f}, 40, 20);
    for (Vec3& p : saddle.positions) p.z *= smoothstep(0.16f, -0.12f, p.x) * 0.75f + 0.25f;  // narrow nose
    saddle.place(std::atan2(-stand.forward.z, stand.forward.x), stand.at(0.245f, 0.925f));
    world.add(std::move(saddle), plain({0.28f, 0.12f, 0.05f}), Sides::Solid);
    add_flowers(world, stand);
    world.add_lamp(stand.at(0.93f, 0.74f) - 0.03f * Vec3{0, 0, 1}, 0.016f, {26, 24, 20});
    world.add_lamp(stand.at(-0.33f, 0.66f) - 0.03f * Vec3{0, 0, 1}, 0.010f, {24, 1.2f, 0.8f});
}

}  // namespace petzval::scene
