// `random`: another scene for every seed, composed as a photographer would: something worth a picture in the
// middle distance, things about it, a place behind, and more often than not something before it.
#include "scene/made_up/made_up.h"

#include "scene/built_in/scenes.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

constexpr int kFrames = 24;

// A colour by its hue (0…1 around the circle), how far from grey, and how bright.
Vec3 colour_of(float hue, float saturation, float value) {
    const auto channel = [&](float offset) {
        return value * (1 - saturation * (0.5f - 0.5f * std::cos(2 * kPi * (hue + offset))));
    };
    return {channel(0), channel(2.0f / 3), channel(1.0f / 3)};
}

// Quiet walls of one temperature, things of neighbouring hues, one of the opposite.
Palette palette_of(Dice& dice) {
    Palette p;
    // Dyes and materials: brick, wood, ochre, leaf, sea, slate, ink, rose.
    constexpr std::array<float, 9> kHues{0.0f, 0.04f, 0.08f, 0.12f, 0.28f, 0.46f, 0.56f, 0.63f, 0.93f};
    const float hue = dice.of(kHues), warm = dice.chance(0.65f) ? 0.07f : 0.55f;
    for (Vec3& wall : p.walls)
        wall = colour_of(warm + dice.either(0.06f), dice.between(0.05f, 0.45f), dice.between(0.16f, 0.72f));
    for (Vec3& thing : p.things)
        thing = colour_of(dice.chance(0.6f) ? hue + dice.either(0.05f) : dice.of(kHues),
                          dice.between(0.15f, 0.8f), dice.octaves(0.06f, 0.7f));
    p.things[0] = colour_of(warm, 0.1f, dice.between(0.65f, 0.82f));
    p.things[1] = colour_of(hue + 0.5f, 0.3f, dice.octaves(0.03f, 0.12f));
    p.things[5] = colour_of(dice.of(kHues), 0.9f, dice.between(0.45f, 0.75f));
    return p;
}

// Radius of the blur at depth z, as a share of the width of the picture.
float blur(const Camera& c, float z) {
    const double f_m = c.focal_length_mm / 1000;
    const double diameter_mm = c.focal_length_mm / c.f_number * f_m / (c.focus_distance_m - f_m) *
                               std::abs(1 - c.focus_distance_m / double(z));
    return float(0.5 * diameter_mm / c.sensor_width_mm);
}

void choose_camera(MadeUp& shot, Dice& dice) {
    constexpr std::array<double, 8> kFocal{24, 35, 35, 50, 50, 75, 85, 135};
    Camera& c = shot.camera;
    c.focal_length_mm = dice.of(kFocal), c.sensor_width_mm = 36;
    shot.tan_x = float(18 / c.focal_length_mm), shot.tan_y = shot.tan_x * 9 / 16;
    shot.subject_m = dice.octaves(0.5f, 9), shot.frame_m = 2 * shot.tan_y * shot.subject_m;
    shot.near_m = shot.subject_m * dice.between(0.2f, 0.6f);
    shot.back_m =
        shot.subject_m * (shot.setting == Setting::Wall ? dice.between(1.2f, 1.8f) : dice.octaves(2.2f, 9));
    const float what = dice.share();
    const float focus = what < 0.62f ? shot.subject_m : what < 0.84f ? shot.back_m : shot.near_m;
    c.focus_distance_m = double(focus) * double(dice.between(0.96f, 1.04f));
    c.f_number = dice.octaves(0.7f, 16);
    // Neither all sharp, nor blurred so far that nothing can be made out.
    const float most = std::max(blur(c, shot.near_m), blur(c, shot.back_m));
    c.f_number *= std::max(1.0, double(most) / 0.13) * std::min(1.0, double(most) / 0.008);
    c.f_number = std::round(100 * std::clamp(c.f_number, 0.7, 16.0)) / 100;
    c.focus_distance_m = std::round(1000 * c.focus_distance_m) / 1000;
}

void choose_view(MadeUp& shot, Dice& dice) {
    shot.slope_x = dice.chance(0.35f) ? dice.either(0.12f) : 0;
    shot.slope_z = dice.chance(0.35f) ? dice.between(-0.06f, 0.12f) : 0;
    // The subject stands on the lower third, seen from its knee to above its head.
    const float eye = shot.frame_m * dice.between(0.2f, 0.95f);
    const float pitch = dice.between(0.45f, 0.95f) * shot.tan_y - eye / shot.subject_m + shot.slope_z;
    const float yaw = dice.either(0.15f);
    shot.view = Viewpoint::looking({0, eye, 0}, {yaw, eye + pitch, 1});
    if (dice.chance(0.25f)) {  // held at a slant
        const float roll = dice.either(0.12f), c = std::cos(roll), s = std::sin(roll);
        const Vec3 right = shot.view.right, up = shot.view.up;
        shot.view.right = c * right + s * up, shot.view.up = c * up - s * right;
    }
    // Over the shot what is near crosses a tenth to a half of the frame.
    const float way = 2 * shot.tan_x * shot.near_m * dice.between(0.1f, 0.5f);
    shot.move = way * (dice.chance(0.5f) ? 1.0f : -1.0f) * shot.view.right +
                (dice.chance(0.4f) ? dice.either(0.12f) * shot.near_m : 0) * shot.view.forward;
    if (dice.chance(0.35f)) shot.subject_move = shot.frame_m * Vec3{dice.either(0.5f), 0, dice.either(0.3f)};
}

void build(World& world, const MadeUp& shot, float time) {
    world.view = shot.view;
    world.view.position += time * shot.move;
    add_place(world, shot);
    add_subject(world, shot, time);
    add_near(world, shot);
    add_lamps(world, shot);
}

}  // namespace

MadeUp made_up(std::uint64_t seed) {
    MadeUp shot;
    shot.seed = seed;
    Dice dice = shot.dice(kShotPart);
    shot.setting = Setting(dice.below(kSettings));
    shot.palette = palette_of(dice);
    choose_camera(shot, dice);
    choose_view(shot, dice);
    return shot;
}

void add_subject(World& world, const MadeUp& shot, float time) {
    Dice dice = shot.dice(kThingsPart);
    // A third off the middle, as tall as two thirds of the frame, the others farther, nearer and smaller.
    const float u = (dice.chance(0.5f) ? 1.0f : -1.0f) * dice.between(0.0f, 0.45f);
    const float height = shot.frame_m * dice.between(0.45f, 0.95f);
    const Vec3 foot = shot.foot(u, shot.subject_m) + time * shot.subject_move;
    if (dice.chance(0.2f))
        add_person(world, dice, shot.palette, foot, height);
    else
        add_thing(world, dice, shot.palette, foot, height);
    const int others = dice.from_to(2, 7);
    for (int i = 0; i < others; ++i) {
        const float side = i % 2 == 0 ? -1.0f : 1.0f;
        const float z =
            shot.subject_m * dice.octaves(0.8f, std::min(4.0f, 0.85f * shot.back_m / shot.subject_m));
        const float beside = u + side * dice.between(0.35f, 1.1f);
        const float small =
            shot.frame_m * dice.between(0.2f, 0.6f) * std::sqrt(std::max(1.0f, z / shot.subject_m));
        add_thing(world, dice, shot.palette, shot.foot(beside, z), small);
    }
}

BuiltInScene random_scene(std::uint64_t seed) {
    const MadeUp shot = made_up(seed);
    BuiltInScene scene;
    scene.summary = {"random", "another scene for every seed, from a still life to a street at night",
                     shot.camera, kFrames};
    scene.build = [shot](World& world, float time) { build(world, shot, time); };
    return scene;
}

}  // namespace petzval::scene
