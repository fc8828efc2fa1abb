// Light, sky, the floor and the background.
#include "scene/built_in/plants.h"
#include "scene/made_up/made_up.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

struct Mood {
    Vec3 horizon, zenith;      // sky
    Vec3 sun, above, below;    // irradiance
    float sun_radius = 0.02f;  // tangent
};

Mood mood_of(Setting setting, Dice& dice) {
    switch (setting) {
        case Setting::Street:
        case Setting::Wall:
        case Setting::Garden: {
            const float overcast = dice.share();
            return {mix(Vec3{0.85f, 0.88f, 0.9f}, Vec3{0.7f, 0.72f, 0.74f}, overcast),
                    mix(Vec3{0.26f, 0.44f, 0.80f}, Vec3{0.6f, 0.62f, 0.66f}, overcast),
                    mix(3.0f, 0.9f, overcast) * Vec3{1, 0.92f, 0.8f},
                    mix(Vec3{1.0f, 1.2f, 1.5f}, Vec3{1.6f, 1.65f, 1.7f}, overcast),
                    {0.5f, 0.45f, 0.4f},
                    mix(0.02f, 0.3f, overcast)};
        }
        case Setting::Dusk:
            return {{0.36f, 0.24f, 0.20f}, {0.05f, 0.09f, 0.20f}, 0.4f * Vec3{1, 0.6f, 0.35f},
                    {0.36f, 0.40f, 0.52f}, {0.22f, 0.18f, 0.15f}, 0.3f};
        case Setting::Night:
            return {{0.05f, 0.04f, 0.05f}, {0.012f, 0.02f, 0.05f}, 0.12f * Vec3{0.6f, 0.75f, 1},
                    {0.08f, 0.09f, 0.13f}, {0.05f, 0.04f, 0.03f},  0.3f};
        case Setting::Room:
            return {{0.36f, 0.33f, 0.30f}, {0.5f, 0.5f, 0.52f},  1.5f * Vec3{1, 0.92f, 0.8f},
                    {1.0f, 0.98f, 0.95f},  {0.5f, 0.42f, 0.34f}, 0.25f};
        case Setting::Studio:
            break;
    }
    return {{0.55f, 0.56f, 0.58f}, {0.7f, 0.7f, 0.72f}, 1.8f * Vec3{1, 0.97f, 0.92f},
            {0.9f, 0.9f, 0.92f},   {0.5f, 0.5f, 0.5f},  0.35f};
}

void add_light(World& world, const MadeUp& shot, Dice& dice) {
    const Mood mood = mood_of(shot.setting, dice);
    const float stops = std::exp2(dice.between(-0.5f, 0.5f));
    world.sky = [=](Vec3 d) {
        return stops * mix(mood.horizon, mood.zenith, smoothstep(0, 0.45f, normalised(d).y));
    };
    world.ambient_above = stops * mood.above, world.ambient_below = stops * mood.below;
    const float azimuth = dice.either(2.4f), height = dice.between(0.35f, 1.4f);
    world.lights.push_back(
        {{std::sin(azimuth), height, -std::cos(azimuth)}, stops * mood.sun, mood.sun_radius, true});
    if (!shot.is_dark()) return;
    for (int i = 0; i < 3; ++i) {  // lamps out of the picture light what is near
        const float z = shot.subject_m * dice.octaves(0.5f, 3), power = dice.between(0.5f, 2.5f);
        const Vec3 at = shot.at(dice.either(1.2f), dice.between(0.8f, 1.8f), z);
        const Vec3 tint = mix(Vec3{1, 0.62f, 0.3f}, Vec3{0.7f, 0.85f, 1}, dice.share() * dice.share());
        world.lights.push_back(
            {at, stops * power * shot.frame_m * shot.frame_m * tint, 0.15f * shot.frame_m});
    }
}

// Cells of about the same size in the picture: as far apart as they are away.
Mesh floor_mesh(const MadeUp& shot) {
    constexpr int kRows = 44, kColumns = 36;
    const float first = 0.4f * shot.near_m, last = 1.02f * shot.back_m, wide = 2.2f * shot.tan_x;
    const Vec3 normal = normalised({-shot.slope_x, 1, -shot.slope_z});
    Mesh mesh;
    for (int j = 0; j <= kRows; ++j)
        for (int i = 0; i <= kColumns; ++i) {
            const float z = first * std::pow(last / first, float(j) / kRows);
            const float x = (2 * float(i) / kColumns - 1) * (wide * z + 0.6f * shot.frame_m);
            mesh.positions.push_back(shot.on_floor(shot.ground.x + x, shot.ground.z + z));
            mesh.normals.push_back(normal);
            mesh.uv.push_back({x / shot.frame_m, z / shot.frame_m});
        }
    for (std::uint32_t j = 0; j < kRows; ++j)
        for (std::uint32_t i = 0; i < kColumns; ++i) {
            const std::uint32_t a = j * (kColumns + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + kColumns + 1});
            mesh.triangles.push_back({a + 1, a + kColumns + 2, a + kColumns + 1});
        }
    return mesh;
}

// Setts, boards, cloth, lawn; finer detail fades where it would be smaller than a pixel.
Paint floor_paint(const MadeUp& shot, Dice& dice) {
    const Vec3 first = dice.of(shot.palette.walls);
    const Vec3 second =
        shot.setting == Setting::Garden ? Vec3{0.14f, 0.22f, 0.05f} : 0.6f * dice.of(shot.palette.walls);
    const float period = dice.octaves(0.08f, 0.4f), fades_m = 4 * shot.subject_m;
    const int kind = shot.setting == Setting::Garden   ? 0
                     : shot.setting == Setting::Studio ? 1
                                                       : dice.from_to(1, 4);
    const std::uint32_t seed = dice.whole();
    const Vec3 eye = shot.ground;
    return [=](const SurfacePoint& p) {
        const float fade = smoothstep(fades_m, 0.25f * fades_m, p.position.z - eye.z);
        const Vec3 q{p.u, 0, p.v};
        const float rough = 1 + 0.14f * fade * noise(40.0f * q) + 0.15f * fractal_noise(1.6f * q, 2);
        float t = 0.5f;
        if (kind == 0) t = smoothstep(-0.3f, 0.4f, fractal_noise(0.9f * q, 3));
        if (kind == 2) {
            const Brick b = brick(p.u / period, p.v / period, 0.08f, 0.10f);
            t = mix(0.35f, 0.3f * (1 - b.mortar) * cell_value(b.column, b.row, seed) + b.mortar, fade);
        }
        if (kind == 3) t = mix(0.5f, checks(p.u / period, p.v / period, 0.05f), fade);
        if (kind == 4)
            t = mix(0.3f,
                    1 - stripes(p.u / period, 0.95f, 0.03f) +
                        0.3f * noise({12 * p.u / period, 0, 0.6f * p.v / period}),
                    fade);
        return Matter{rough * mix(first, second, std::clamp(t, 0.0f, 1.0f)), {}};
    };
}

// A wall across the view: bricks with windows, lit ones by night; a room's with pictures; a plain one.
Paint wall_paint(const MadeUp& shot, Dice& dice, float height) {
    const Vec3 wall = dice.of(shot.palette.walls), other = 0.5f * dice.of(shot.palette.walls);
    const bool has_windows = shot.setting == Setting::Street || shot.is_dark() || dice.chance(0.4f);
    const bool has_bricks = shot.setting != Setting::Studio && dice.chance(0.5f);
    const float pane_x = dice.between(0.15f, 0.4f), pane_y = dice.between(0.2f, 0.42f);
    const float bay = height * dice.between(0.2f, 0.6f), storey = bay * dice.between(0.7f, 1.5f),
                course = 0.05f * shot.frame_m * shot.back_m / shot.subject_m;
    const float lit = shot.is_dark()                  ? dice.between(0.25f, 0.6f)
                      : shot.setting == Setting::Room ? 0.7f
                                                      : 0.0f;
    const float strength =
        shot.setting == Setting::Night ? dice.octaves(0.2f, 1.5f) : dice.octaves(0.6f, 2.5f);
    const std::uint32_t seed = dice.whole();
    return [=](const SurfacePoint& p) {
        const float x = p.position.x / bay + 50, y = p.position.y / storey + 50;
        const int i = int(std::floor(x)), j = int(std::floor(y));
        const float u = std::abs(x - float(i) - 0.5f), v = std::abs(y - float(j) - 0.5f);
        const float pane = smoothstep(pane_x, 0.95f * pane_x, u) * smoothstep(pane_y, 0.96f * pane_y, v) *
                           smoothstep(0.008f, 0.016f, u);
        float t = 0.5f + 0.5f * fractal_noise((3 / height) * p.position, 2);
        if (has_bricks) {
            const Brick b =
                brick(p.position.x / (2.6f * course) + 90, p.position.y / course + 90, 0.06f, 0.15f);
            t = 0.6f * b.mortar + 0.4f * cell_value(b.column, b.row, seed);
        }
        const Vec3 plain = mix(wall, other, t);
        if (!has_windows) return Matter{plain, {}};
        const bool glows = cell_value(i, j, seed + 1) < lit;
        const Vec3 glow = strength * cell_value(i, j, seed + 2) *
                          mix(Vec3{1, 0.7f, 0.36f}, Vec3{0.75f, 0.88f, 1},
                              smoothstep(0.6f, 0.8f, cell_value(i, j, seed + 3)));
        return Matter{mix(plain, Vec3{0.05f, 0.06f, 0.08f}, pane), glows ? pane * glow : Vec3{}};
    };
}

void add_wall(World& world, const MadeUp& shot, Dice& dice) {
    const float z = shot.back_m, wide = 2.4f * shot.tan_x * z + shot.frame_m,
                height = 2.4f * shot.tan_y * z + shot.frame_m;
    const float turn = shot.setting == Setting::Studio ? 0 : dice.either(0.35f);
    const Vec3 middle = shot.on_floor(shot.ground.x, shot.ground.z + z);
    const Vec3 along{2 * wide, 0, 2 * wide * turn};
    const bool is_low =
        (shot.setting == Setting::Street || shot.setting == Setting::Wall) && dice.chance(0.4f);
    const float top = is_low ? height * dice.between(0.3f, 0.6f) : height;
    world.add(
        patch(middle - 0.5f * along - Vec3{0, 0.5f * height, 0}, along, {0, 0.5f * height + top, 0}, 40, 16),
        wall_paint(shot, dice, 2 * shot.tan_y * z), Sides::Sheet);
}

void add_shrubs(World& world, const MadeUp& shot, Dice& dice, int count) {
    for (int i = 0; i < count; ++i) {
        const float z = mix(0.45f, 0.97f, dice.share()) * shot.back_m,
                    size = shot.tan_y * z * dice.between(0.12f, 0.4f);
        const Vec3 foot = shot.foot(dice.either(1.1f), z);
        const Vec3 dark = dice.between(0.6f, 1.2f) * Vec3{0.05f, 0.10f, 0.03f};
        const Vec3 lit =
            mix(Vec3{0.26f, 0.36f, 0.08f}, Vec3{0.6f, 0.40f, 0.09f}, dice.share() * dice.share());
        const float fine = 6 / size;
        Vec3 centre = foot + Vec3{0, 0.8f * size, 0};
        if (dice.chance(0.5f)) {  // a tree
            Tubes trunk;
            centre.y += 1.4f * size;
            trunk.line(foot, centre, 0.12f * size);
            world.add(std::move(trunk), plain_paint({0.12f, 0.09f, 0.06f}));
        }
        world.add(
            bush(centre, {size, dice.between(0.8f, 1.4f) * size, size}, 0.3f),
            [=](const SurfacePoint& p) {
                return Matter{mix(dark, lit, smoothstep(-0.6f, 0.8f, fractal_noise(fine * p.position, 3))),
                              {}};
            },
            Sides::Solid);
    }
}

// Pictures and posters on the wall or just before it.
void add_pictures(World& world, const MadeUp& shot, Dice& dice) {
    for (int i = dice.from_to(2, 6); i > 0; --i) {
        const float z = 0.9f * shot.back_m, tall = shot.tan_y * z * dice.between(0.25f, 0.8f);
        const float wide = tall * dice.between(0.6f, 1.6f);
        const Vec3 corner = shot.at(dice.between(-1.1f, 0.8f), dice.between(-0.4f, 0.5f), z);
        const Paint paint = dice.chance(0.4f)
                                ? print_paint(dice, dice.of(shot.palette.walls), dice.of(shot.palette.things),
                                              float(dice.from_to(3, 9)), float(dice.from_to(1, 5)), 0)
                                : made_up_paint(dice, shot.palette, {corner, tall, wide / tall, 1});
        world.add(patch(corner, {wide, 0, 0}, {0, tall, 0}, 4, 4), paint, Sides::Leaf);
    }
}

// Signs that shine, over the heads.
void add_signs(World& world, const MadeUp& shot, Dice& dice) {
    for (int i = dice.from_to(1, 4); i > 0; --i) {
        const float z = shot.back_m * dice.between(0.6f, 0.95f),
                    tall = shot.tan_y * z * dice.between(0.08f, 0.25f);
        const float wide = tall * dice.between(1.5f, 5);
        const Vec3 corner = shot.at(dice.either(0.8f), dice.between(0.1f, 0.7f), z);
        const Vec3 ink = dice.of(shot.palette.things) + Vec3{0.1f, 0.1f, 0.1f};
        world.add(patch(corner, {wide, 0, 0}, {0, tall, 0}, 2, 2),
                  print_paint(dice, 0.15f * dice.of(shot.palette.things), ink, std::floor(wide / tall / 0.7f),
                              1, dice.octaves(1, 6)),
                  Sides::Sheet);
    }
}

}  // namespace

void add_place(World& world, const MadeUp& shot) {
    Dice dice = shot.dice(kPlacePart);
    add_light(world, shot, dice);
    world.add(floor_mesh(shot), floor_paint(shot, dice), Sides::Sheet);
    if (shot.setting != Setting::Garden || dice.chance(0.3f)) add_wall(world, shot, dice);
    if (shot.setting == Setting::Garden) add_shrubs(world, shot, dice, dice.from_to(8, 18));
    if (shot.setting == Setting::Street && dice.chance(0.6f))
        add_shrubs(world, shot, dice, dice.from_to(1, 5));
    const bool is_indoors = shot.setting == Setting::Room || shot.setting == Setting::Wall;
    if (is_indoors || (shot.setting == Setting::Studio && dice.chance(0.4f))) add_pictures(world, shot, dice);
    if (shot.is_dark() || (shot.setting == Setting::Street && dice.chance(0.3f)))
        add_signs(world, shot, dice);
}

void add_lamps(World& world, const MadeUp& shot) {
    Dice dice = shot.dice(kLampsPart);
    constexpr std::array<Vec3, 6> kColours{{{1, 0.52f, 0.16f},
                                            {1, 0.74f, 0.44f},
                                            {1, 0.92f, 0.80f},
                                            {0.62f, 0.80f, 1},
                                            {1, 0.07f, 0.04f},
                                            {0.10f, 1, 0.45f}}};
    const int count = shot.is_dark() ? dice.from_to(8, 60) : dice.chance(0.35f) ? dice.from_to(2, 14) : 0;
    const float strongest = dice.octaves(4, 2000);
    const float pixel = 2 * shot.tan_x / 320;  // tangent of one of a small picture
    Vec3 from = shot.at(-1.1f, 0.4f, 0.8f * shot.back_m), to = shot.at(1.1f, 0.7f, 0.6f * shot.back_m);
    for (int i = 0; i < count; ++i) {
        const float z = mix(1.2f * shot.subject_m, 0.96f * shot.back_m, std::sqrt(dice.share()));
        Vec3 at = shot.at(dice.either(1.05f), dice.between(-0.15f, 0.85f), z);
        if (i % 3 == 0) {  // on a string across the view
            const float t = float(i) / float(count);
            at = mix(from, to, t) - Vec3{0, 0.3f * (to.x - from.x) * t * (1 - t), 0};
        }
        if (at.y < shot.on_floor(at.x, at.z).y) continue;
        const float distance = at.z - shot.view.position.z;
        const float radius = distance * pixel * dice.octaves(0.12f, 1.2f);
        world.add_lamp(at, radius, strongest * dice.octaves(0.05f, 1) * dice.of(kColours));
    }
}

}  // namespace petzval::scene
