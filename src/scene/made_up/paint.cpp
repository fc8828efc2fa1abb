// Patterns that things are painted with, in colours that go together.
#include "scene/made_up/made_up.h"
#include "scene/textures.h"

namespace petzval::scene {
namespace {

struct Pattern {
    Vec3 first, second;
    float period = 1;  // sizes
    float turn_x = 1, turn_y = 0;
    std::uint32_t seed = 0;
};

// 0…1 between the two colours, at (x, y) in periods.
using Drawing = float (*)(float x, float y, std::uint32_t seed);

float striped(float x, float, std::uint32_t) { return stripes(x, 0.45f, 0.08f); }
float checked(float x, float y, std::uint32_t) { return checks(x, y, 0.08f); }
float gingham(float x, float y, std::uint32_t) {
    return 0.5f * (stripes(x, 0.5f, 0.06f) + stripes(y, 0.5f, 0.06f));
}
float bricked(float x, float y, std::uint32_t seed) {
    const Brick b = brick(x, 2 * y, 0.08f, 0.16f);
    return std::max(b.mortar, 0.55f * cell_value(b.column, b.row, seed));
}
float dotted(float x, float y, std::uint32_t) {
    const float u = x - std::floor(x) - 0.5f, v = y - std::floor(y) - 0.5f;
    return smoothstep(0.32f, 0.26f, std::hypot(u, v));
}
float tiled(float x, float y, std::uint32_t seed) {
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const float u = x - float(i), v = y - float(j);
    const float inside = smoothstep(0.02f, 0.06f, std::min({u, v, 1 - u, 1 - v}));
    return inside * (0.25f + 0.75f * cell_value(i, j, seed));
}

constexpr std::array<Drawing, 6> kDrawings{striped, checked, gingham, bricked, dotted, tiled};

Paint drawn(const Pattern& pattern, Drawing drawing, const Surface& s) {
    return [=](const SurfacePoint& p) {
        const float x = p.u * s.u_sizes / pattern.period, y = p.v * s.v_sizes / pattern.period;
        const float a = pattern.turn_x * x + pattern.turn_y * y, b = pattern.turn_x * y - pattern.turn_y * x;
        const float wear = 1 + 0.10f * noise((14 / s.size_m) * (p.position - s.origin));
        return Matter{wear * mix(pattern.first, pattern.second, drawing(a + 40, b + 40, pattern.seed)), {}};
    };
}

// Grain along one axis, as of wood or of stone in layers.
Paint grained(const Pattern& pattern, const Surface& s, bool upright) {
    return [=](const SurfacePoint& p) {
        Vec3 q = (1 / (s.size_m * pattern.period)) * (p.position - s.origin);
        if (upright) std::swap(q.x, q.y);
        const float grain =
            noise({0.3f * q.x, 3 * q.y, 3 * q.z}) + 0.6f * noise({0.8f * q.x, 8 * q.y, 8 * q.z});
        return Matter{mix(pattern.first, pattern.second, std::clamp(0.4f + 0.45f * grain, 0.0f, 1.0f)), {}};
    };
}

Paint clouded(const Pattern& pattern, const Surface& s, float contrast, int octaves) {
    return [=](const SurfacePoint& p) {
        const float n = fractal_noise((1 / (s.size_m * pattern.period)) * (p.position - s.origin), octaves);
        return Matter{mix(pattern.first, pattern.second, std::clamp(0.5f + contrast * n, 0.0f, 1.0f)), {}};
    };
}

}  // namespace

Paint plain_paint(Vec3 albedo) {
    return [=](const SurfacePoint&) { return Matter{albedo, {}}; };
}

Paint made_up_paint(Dice& dice, const Palette& palette, const Surface& surface) {
    Pattern pattern;
    const int first = dice.below(6);
    pattern.first = palette.things[std::size_t(first)];
    pattern.second = palette.things[std::size_t((first + 1 + dice.below(5)) % 6)];
    pattern.period = dice.octaves(0.05f, 0.4f);
    pattern.seed = dice.whole();
    if (dice.chance(0.25f)) pattern.turn_x = pattern.turn_y = 0.7071f;
    const float kind = dice.share();
    if (kind < 0.24f) {  // one colour, hardly mottled
        pattern.second = 0.8f * pattern.first;
        return clouded(pattern, surface, 0.4f, 2);
    }
    if (kind < 0.40f || !surface.has_uv) return grained(pattern, surface, dice.chance(0.5f));
    if (kind < 0.52f) return clouded(pattern, surface, 0.8f, 3);
    return drawn(pattern, dice.of(kDrawings), surface);
}

Paint print_paint(Dice& dice, Vec3 back, Vec3 ink, float columns, float lines, float glow) {
    const std::uint32_t seed = dice.whole();
    return [=](const SurfacePoint& p) {
        const float line = std::floor(lines * p.v), y = (lines * p.v - line - 0.18f) / 0.64f;
        const float x = columns * p.u + 31 * line;
        const int i = int(std::floor(x));
        const float u = (x - float(i) - 0.12f) / 0.76f;
        float drawn = 0;
        if (u > 0 && u < 1 && y > 0 && y < 1) {
            const int column = int(3 * u), row = int(5 * y);
            const bool stem = column == int(2.99f * cell_value(i, 0, seed));
            const bool bar = row == int(4.99f * cell_value(i, 1, seed));
            drawn = stem || bar || cell_value(3 * i + column, row, seed + 1) > 0.7f ? 1.0f : 0.0f;
        }
        const float rim = smoothstep(0.02f, 0.03f, std::min({p.u, 1 - p.u, p.v, 1 - p.v}));
        const Vec3 colour = rim * mix(back, ink, drawn);
        return Matter{colour, glow * colour};
    };
}

}  // namespace petzval::scene
