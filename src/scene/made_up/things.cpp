// Things that stand about: boxes, balls, vases, books, signs, plants, frames, people.
#include "scene/built_in/plants.h"
#include "scene/made_up/made_up.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

void add_box(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const Vec3 half = 0.5f * height * Vec3{dice.between(0.5f, 1.2f), 1, dice.between(0.5f, 1.0f)};
    const Vec3 centre = foot + Vec3{0, half.y, 0};
    Mesh mesh = box({}, half, 10);
    mesh.place(dice.either(0.7f), centre);
    world.add(std::move(mesh), made_up_paint(dice, palette, {centre, height, 1 / height, 1 / height}),
              Sides::Solid);
}

void add_ball(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const float r = 0.5f * height;
    const Vec3 centre = foot + Vec3{0, r, 0};
    world.add(sphere(centre, {r, r, r}, 40, 24), made_up_paint(dice, palette, {centre, height, 3, 1.5f}),
              Sides::Solid);
}

// Bottles, vases, lamps' feet: a turned outline that never folds.
void add_turned(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const float belly = dice.between(0.16f, 0.34f), neck = belly * dice.between(0.25f, 0.9f);
    const float low = dice.between(0.6f, 1.0f) * belly, bend = dice.between(0.3f, 0.7f);
    std::vector<std::array<float, 2>> outline{{0, 0}};
    for (int i = 0; i <= 18; ++i) {
        const float t = float(i) / 18;
        const float rising = mix(low, belly, smoothstep(0, bend, t));
        outline.push_back({height * mix(rising, neck, smoothstep(bend, 0.95f, t)), height * t});
    }
    outline.push_back({0, height});
    world.add(lathe(foot, outline, 40), made_up_paint(dice, palette, {foot, height, 1.5f, 1}), Sides::Solid);
}

void add_stack(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const int count = dice.from_to(2, 5);
    const float each = height / float(count);
    for (int i = 0; i < count; ++i) {
        Mesh mesh = box({}, {height * dice.between(0.32f, 0.5f), 0.48f * each, height * 0.35f}, 6);
        const Vec3 centre = foot + Vec3{height * dice.either(0.06f), each * (float(i) + 0.5f), 0};
        mesh.place(dice.either(0.4f), centre);
        world.add(std::move(mesh), made_up_paint(dice, palette, {centre, height, 1 / height, 1 / height}),
                  Sides::Solid);
    }
}

void add_sign(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const float wide = height * dice.between(0.5f, 1.3f), tall = height * dice.between(0.3f, 0.5f);
    Tubes pole;
    pole.line(foot, foot + Vec3{0, height, 0}, 0.03f * height);
    world.add(std::move(pole), plain_paint({0.12f, 0.12f, 0.13f}));
    const float lines = float(dice.from_to(1, 4));
    const Paint print = print_paint(dice, dice.of(palette.things), dice.of(palette.walls),
                                    std::max(2.0f, std::floor(lines * wide / tall * 0.9f)), lines, 0);
    const Vec3 corner = foot + Vec3{-0.5f * wide, height - tall, -0.035f * height};
    world.add(patch(corner, {wide, 0, 0.2f * wide * dice.either(1)}, {0, tall, 0}, 6, 4), print, Sides::Leaf);
}

void add_plant(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const float pot = 0.3f * height;
    const std::vector<std::array<float, 2>> outline{
        {0, 0}, {0.6f * pot, 0}, {0.75f * pot, 0.9f * pot}, {0.8f * pot, pot}, {0, pot}};
    world.add(lathe(foot, outline, 28), made_up_paint(dice, palette, {foot, pot, 2, 1}), Sides::Solid);
    Mesh green;
    Tubes stalks;
    const int leaves = dice.from_to(9, 26);
    const Vec3 top = foot + Vec3{0, pot, 0};
    for (int i = 0; i < leaves; ++i) {
        const float turn = 2 * kPi * dice.share(), lean = dice.between(0.15f, 1.0f);
        const Vec3 out = normalised({lean * std::cos(turn), 1, lean * std::sin(turn)});
        const float length_m = (height - pot) * dice.between(0.4f, 0.95f), half = 0.12f * length_m;
        const Vec3 stalk = top + 0.45f * length_m * out;
        stalks.line(top, stalk, 0.008f * height);
        green.append(leaf(stalk, stalk + 0.6f * length_m * normalised(out + Vec3{0, -0.5f * lean, 0}),
                          normalised({-out.x, 1, -out.z - 0.3f}), half));
    }
    const Vec3 dark = {0.05f, 0.12f, 0.04f}, bright = {0.26f, 0.38f, 0.10f};
    world.add(std::move(stalks), plain_paint(0.7f * bright));
    world.add(
        std::move(green),
        [=](const SurfacePoint& p) {
            return Matter{
                mix(bright, dark, 0.8f * smoothstep(0.06f, 0.02f, std::abs(p.u - 0.5f)) + 0.2f * p.v), {}};
        },
        Sides::Leaf);
}

// Chairs, railings, ladders: rods between corners.
void add_frame(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    Tubes rods;
    const float wide = height * dice.between(0.4f, 1.6f), deep = height * dice.between(0, 0.5f);
    const float rod = height * dice.octaves(0.012f, 0.035f);
    const int bars = dice.from_to(2, 7);
    for (const float z : {0.0f, deep}) {
        for (int i = 0; i <= bars; ++i) {
            const Vec3 low = foot + Vec3{wide * (float(i) / float(bars) - 0.5f), 0, z};
            rods.line(low, low + Vec3{0, height, 0}, i == 0 || i == bars ? rod : 0.6f * rod);
        }
        for (const float y : {0.25f, 0.97f})
            rods.line(foot + Vec3{-0.5f * wide, y * height, z}, foot + Vec3{0.5f * wide, y * height, z}, rod);
        if (deep < 0.1f * height) break;
    }
    world.add(std::move(rods), made_up_paint(dice, palette, {foot, height, 1, 1, false}));
}

void add_ring(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const float tube = height * dice.between(0.06f, 0.16f);
    const float tilt = dice.either(1.0f);
    const Vec3 centre = foot + Vec3{0, 0.5f * height, 0};
    world.add(torus(centre, {std::sin(tilt), 0, -std::cos(tilt)}, 0.5f * height - tube, tube, 64, 16),
              made_up_paint(dice, palette, {centre, height, 3, 0.5f}), Sides::Solid);
}

// Hair from a skull, combed down and blown aside.
Tubes hair_on(Dice& dice, Vec3 skull, Vec3 radii) {
    Tubes hair;
    const float wind = dice.either(0.7f), length_m = radii.y * dice.between(1.2f, 3.2f);
    const int strands = dice.from_to(120, 320);
    for (int i = 0; i < strands; ++i) {
        const float azimuth = 2 * kPi * dice.share(), polar = 1.3f * dice.share();
        const Vec3 out{std::sin(azimuth) * std::sin(polar), std::cos(polar),
                       -std::cos(azimuth) * std::sin(polar)};
        const float loose = dice.share() * dice.share() * dice.share();
        Vec3 p = skull + out * radii, direction = normalised(Vec3{out.x, loose - 0.5f, out.z});
        std::vector<Vec3> through{p};
        for (int k = 0; k < 9; ++k) {
            const float t = float(k) / 9;
            direction = normalised(direction + 0.5f * Vec3{wind * (0.3f + loose) * t, -1 + 0.6f * loose, 0});
            p += (0.11f * length_m * (1 + 0.5f * loose)) * direction;
            const Vec3 from = p - skull;
            const float inside = length({from.x / radii.x, from.y / radii.y, from.z / radii.z});
            const float least = 1.03f + 0.2f * loose;
            if (inside < least) p = skull + from * (least / inside);
            through.push_back(p);
        }
        hair.curve(through, 2, 0.011f * radii.x, 0.006f * radii.x);
    }
    return hair;
}

using Thing = void (*)(World&, Dice&, const Palette&, Vec3 foot, float height);
constexpr std::array<Thing, 10> kThings{add_box,   add_box,  add_ball,  add_turned, add_turned,
                                        add_stack, add_sign, add_plant, add_frame,  add_ring};

}  // namespace

void add_person(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    const Vec3 skin = dice.between(0.25f, 1.0f) * Vec3{0.66f, 0.44f, 0.33f};
    const Vec3 tint = dice.between(0.1f, 1.0f) * Vec3{0.42f, 0.24f, 0.11f};
    const Vec3 skull = foot + Vec3{0, 0.80f * height, 0}, radii = height * Vec3{0.13f, 0.17f, 0.15f};
    world.add(sphere(foot + Vec3{0, 0.22f * height, 0}, height * Vec3{0.36f, 0.34f, 0.22f}, 40, 24),
              made_up_paint(dice, palette, {foot, height, 2, 1}), Sides::Solid);
    Tubes neck;
    neck.line(foot + Vec3{0, 0.45f * height, 0}, skull, 0.075f * height);
    world.add(std::move(neck), plain_paint(skin));
    world.add(sphere(skull, radii, 36, 24), plain_paint(skin), Sides::Solid);
    world.add(hair_on(dice, skull + Vec3{0, 0, 0.02f * height}, 1.04f * radii), [=](const SurfacePoint& p) {
        const Vec3 q = (1 / height) * (p.position - skull);
        return Matter{(1 + 0.5f * noise({60 * q.x, 8 * q.y, 60 * q.z})) * tint, {}};
    });
}

void add_thing(World& world, Dice& dice, const Palette& palette, Vec3 foot, float height) {
    dice.of(kThings)(world, dice, palette, foot, height);
}

}  // namespace petzval::scene
