// Things before the subject, usually far out of focus: posts, branches, wires, hair, cloth, shoulders.
// Sizes are shares of the frame where it stands, and most of it leaves the frame somewhere.
#include "scene/built_in/plants.h"
#include "scene/made_up/made_up.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

struct Near {
    World& world;
    const MadeUp& shot;
    Dice& dice;
    float z;     // planar distance
    float unit;  // the height of the frame there, m
    Vec3 at(float u, float v, float farther = 1) const { return shot.at(u, v, z * farther); }
    Paint paint(Vec3 origin, float size, bool has_uv = false) const {
        return made_up_paint(dice, shot.palette, {origin, size, 1, 1, has_uv});
    }
};

// Screen position of a thing that does not cover the subject's middle may stand, mostly; sometimes it does.
float aside(Dice& dice) {
    const float u = dice.chance(0.3f) ? dice.between(0, 0.3f) : dice.between(0.3f, 0.85f);
    return dice.chance(0.5f) ? u : -u;
}

void post(const Near& n) {
    Tubes tube;
    const float u = aside(n.dice), lean = n.dice.chance(0.5f) ? 0 : n.dice.either(0.35f);
    const float radius = n.unit * n.dice.octaves(0.02f, 0.09f);
    const Vec3 low = n.at(u - lean, -1.6f);
    tube.line(low, n.at(u + lean, n.dice.chance(0.75f) ? 1.6f : n.dice.between(0, 0.8f)), radius);
    n.world.add(std::move(tube), n.paint(low, 12 * radius));
}

Mesh leaves_along(const Near& n, const std::vector<Vec3>& branch, float length_m, int count, Tubes& stalks) {
    Mesh green;
    for (int i = 0; i < count; ++i) {
        const std::size_t k = 1 + std::size_t(n.dice.below(int(branch.size()) - 1));
        const Vec3 stalk = mix(branch[k - 1], branch[k], n.dice.share());
        const Vec3 along = normalised(branch[k] - branch[k - 1]);
        const Vec3 side = normalised(cross(along, n.shot.view.forward));
        const Vec3 direction =
            normalised(along + (n.dice.chance(0.5f) ? 1.0f : -1.0f) * n.dice.between(0.5f, 1.5f) * side +
                       Vec3{0, -0.3f, 0} + n.dice.either(0.5f) * n.shot.view.forward);
        const float size = length_m * n.dice.between(0.6f, 1.2f);
        const Vec3 base = stalk + 0.2f * size * direction;
        stalks.line(stalk, base, 0.03f * size);
        const Vec3 facing = normalised(Vec3{n.dice.either(0.6f), 0.5f, -0.8f});
        green.append(leaf(base, base + size * direction, facing, size * n.dice.between(0.18f, 0.34f)));
    }
    return green;
}

void branch(const Near& n) {
    const float v = n.dice.between(-0.2f, 1.1f), u = n.dice.chance(0.5f) ? 1.3f : -1.3f;
    const Vec3 from = n.at(u, v), to = n.at(-u * n.dice.between(-0.6f, 1.2f), v + n.dice.either(1.0f),
                                            n.dice.between(0.85f, 1.2f));
    const Vec3 bow = n.unit * Vec3{n.dice.either(0.1f), n.dice.either(0.2f), 0};
    std::vector<Vec3> through;
    for (int i = 0; i <= 14; ++i) {
        const float t = float(i) / 14;
        through.push_back(mix(from, to, t) + 4 * t * (1 - t) * bow +
                          0.02f * n.unit * Vec3{0, noise({4 * t, u, v}), 0});
    }
    Tubes wood;
    const float thick = n.unit * n.dice.octaves(0.008f, 0.04f);
    wood.path(through, thick, 0.35f * thick);
    const int twigs = n.dice.from_to(0, 3);
    for (int i = 0; i < twigs; ++i) {
        const Vec3 root = through[std::size_t(n.dice.from_to(3, 12))];
        wood.path({root, root + n.unit * Vec3{n.dice.either(0.3f), n.dice.either(0.4f), n.dice.either(0.1f)}},
                  0.4f * thick, 0.2f * thick);
    }
    const int count = n.dice.chance(0.3f) ? 0 : n.dice.from_to(4, 26);
    Mesh green = leaves_along(n, through, n.unit * n.dice.between(0.08f, 0.22f), count, wood);
    n.world.add(std::move(wood), n.paint(from, 0.3f * n.unit));
    if (count == 0) return;
    const Vec3 dark = n.dice.between(0.5f, 1.0f) * Vec3{0.10f, 0.20f, 0.05f};
    const Vec3 lit =
        mix(Vec3{0.36f, 0.46f, 0.10f}, Vec3{0.55f, 0.26f, 0.06f}, n.dice.share() * n.dice.share());
    n.world.add(
        std::move(green),
        [=](const SurfacePoint& p) {
            return Matter{(1 - 0.35f * smoothstep(0.06f, 0.02f, std::abs(p.u - 0.5f))) * mix(dark, lit, p.v),
                          {}};
        },
        Sides::Leaf);
}

void wires(const Near& n) {
    Tubes lines;
    const int count = n.dice.from_to(1, 6);
    const float radius = n.unit * n.dice.octaves(0.0015f, 0.012f), slope = n.dice.either(0.8f);
    for (int i = 0; i < count; ++i) {
        const float v = n.dice.either(0.9f), sag = n.dice.between(0, 0.25f);
        lines.curve({n.at(-1.4f, v - slope), n.at(-0.3f, v - 0.2f * slope - sag),
                     n.at(0.4f, v + 0.3f * slope - sag), n.at(1.4f, v + slope)},
                    10, radius, radius);
    }
    n.world.add(std::move(lines), plain_paint(n.dice.between(0.3f, 1.5f) * Vec3{0.1f, 0.1f, 0.11f}));
}

void mesh_fence(const Near& n) {
    Tubes lines;
    const float gap = n.dice.between(0.14f, 0.5f), radius = n.unit * n.dice.octaves(0.002f, 0.012f);
    const bool is_diagonal = n.dice.chance(0.6f);
    const float left = n.dice.chance(0.5f) ? -1.5f : n.dice.between(-0.6f, 0.4f);
    for (float u = left - (is_diagonal ? 3.0f : 0.0f); u < 1.6f; u += gap) {
        const float lean = is_diagonal ? 2.8f * n.shot.tan_y / n.shot.tan_x : 0;
        const auto inside = [&](float a) { return std::clamp(a, left, 1.6f); };
        const auto line = [&](float first,
                              float last) {  // from the lower to the upper border, cut at the left
            const float low = first == last ? 0 : (inside(first) - first) / (last - first);
            const float high = first == last ? 1 : (inside(last) - first) / (last - first);
            if (first != last && std::abs(high - low) < 1e-3f) return;
            lines.line(n.at(mix(first, last, low), -1.4f + 2.8f * low),
                       n.at(mix(first, last, high), -1.4f + 2.8f * high), radius);
        };
        line(u, u + lean);
        if (is_diagonal) line(u + lean, u);
    }
    for (float v = -1.4f; !is_diagonal && v < 1.4f; v += gap * n.shot.tan_x / n.shot.tan_y)
        lines.line(n.at(left, v), n.at(1.6f, v), radius);
    n.world.add(std::move(lines), plain_paint(n.dice.between(0.6f, 3.0f) * Vec3{0.12f, 0.12f, 0.125f}));
}

void strands(const Near& n) {
    Tubes hair;
    const float side = n.dice.chance(0.5f) ? 1.0f : -1.0f, radius = n.unit * n.dice.octaves(0.0008f, 0.003f);
    const int count = n.dice.from_to(15, 90);
    const float width = n.dice.between(0.2f, 0.8f), bow = n.dice.either(0.5f);
    for (int i = 0; i < count; ++i) {
        const float u = side * (1.15f - width * n.dice.share()), loose = n.dice.either(0.25f);
        hair.curve(
            {n.at(u, 1.3f), n.at(u - side * (0.1f + bow + loose), 0.3f), n.at(u + loose + 0.3f * bow, -0.5f),
             n.at(u - 1.5f * loose, n.dice.between(-1.4f, -0.7f))},
            6, radius, 0.6f * radius);
    }
    n.world.add(std::move(hair), plain_paint(n.dice.between(0.1f, 1.0f) * Vec3{0.40f, 0.24f, 0.12f}));
}

// A curtain, a flag, a sleeve: folds across, an end somewhere in the frame.
void cloth(const Near& n) {
    const float side = n.dice.chance(0.5f) ? 1.0f : -1.0f, reach = n.dice.between(0.3f, 0.9f);
    const float folds = n.dice.between(2.0f, 6.0f), deep = 0.05f * n.unit * n.dice.between(0.3f, 1.5f);
    const Vec3 outer = n.at(side * 1.5f, -1.5f), inner = n.at(side * (1.15f - reach), -1.5f),
               top = n.at(side * 1.5f, 1.5f);
    Mesh sheet = patch(outer, inner - outer, top - outer, 60, 14);
    for (std::size_t i = 0; i < sheet.positions.size(); ++i) {
        const float u = sheet.uv[i][0], v = sheet.uv[i][1],
                    phase = 2 * kPi * (folds * u + 0.4f * std::sin(3 * v));
        const Vec3 across = normalised(inner - outer), out = -n.shot.view.forward;
        sheet.positions[i] += deep * std::sin(phase) * out + 0.5f * deep * std::sin(2.6f * v + 1) * across;
        const float slope = 2 * kPi * folds * deep * std::cos(phase) / length(inner - outer);
        sheet.normals[i] = normalised(out - slope * across);
    }
    const Paint paint = made_up_paint(n.dice, n.shot.palette, {outer, 0.6f * n.unit, 1, 2});
    n.world.add(std::move(sheet), paint, Sides::Leaf);
}

// A shoulder, a ball, a vase on the table: round and large, cut by the frame.
void shoulder(const Near& n) {
    const float u = (n.dice.chance(0.5f) ? 1.0f : -1.0f) * n.dice.between(0.5f, 1.0f);
    const float size = n.unit * n.dice.between(0.25f, 0.6f);
    const Vec3 foot = n.at(u, -1.1f) - Vec3{0, 0.35f * size, 0};
    if (n.dice.chance(0.5f)) return add_person(n.world, n.dice, n.shot.palette, foot, 1.5f * size);
    const Vec3 centre = foot + Vec3{0, 0.5f * size, 0};
    n.world.add(
        sphere(centre, size * Vec3{n.dice.between(0.5f, 1.0f), n.dice.between(0.5f, 0.9f), 0.5f}, 48, 28),
        made_up_paint(n.dice, n.shot.palette, {centre, size, 3, 1.5f}), Sides::Solid);
}

// A thing like those about the subject, standing near the lens.
void still(const Near& n) {
    const float height = n.unit * n.dice.between(0.35f, 0.8f);
    const Vec3 foot = n.at(0.9f * aside(n.dice), -1) - Vec3{0, height * n.dice.between(0, 0.3f), 0};
    add_thing(n.world, n.dice, n.shot.palette, foot, height);
}

// Panes of a window, slats, a gate: flat bars at one depth.
void bars(const Near& n) {
    const bool is_upright = n.dice.chance(0.6f);
    const float gap = n.dice.between(0.3f, 1.1f), wide = n.dice.between(0.03f, 0.16f),
                first = n.dice.between(-1.2f, -0.6f);
    const Vec3 origin = n.at(0, 0);
    const Paint paint = n.paint(origin, n.unit);
    for (float a = first; a < 1.1f; a += gap) {
        const Vec3 corner = is_upright ? n.at(a, -1.3f) : n.at(-1.3f, a);
        const Vec3 along = is_upright ? n.at(a, 1.3f) - corner : n.at(1.3f, a) - corner;
        const Vec3 across =
            is_upright ? n.at(a + wide, -1.3f) - corner : n.at(-1.3f, a + 1.8f * wide) - corner;
        n.world.add(is_upright ? patch(corner, across, along, 2, 20) : patch(corner, along, across, 20, 2),
                    paint, Sides::Leaf);
    }
}

using Kind = void (*)(const Near&);
constexpr std::array<Kind, 14> kKinds{post,    post,  branch,   branch,   branch, wires, mesh_fence,
                                      strands, cloth, shoulder, shoulder, still,  still, bars};

}  // namespace

void add_near(World& world, const MadeUp& shot) {
    Dice dice = shot.dice(kNearPart);
    if (dice.chance(0.08f)) return;
    const int count = dice.chance(0.35f) ? 2 : 1;
    for (int i = 0; i < count; ++i) {
        const float z = i == 0 ? shot.near_m : mix(shot.near_m, shot.subject_m, dice.between(0.2f, 0.7f));
        dice.of(kKinds)({world, shot, dice, z, 2 * shot.tan_y * z});
    }
}

}  // namespace petzval::scene
