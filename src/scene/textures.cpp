#include "scene/textures.h"

#include "scene/sampling.h"

namespace petzval::scene {
namespace {

// Largest integer <= x; std::floor is a call on baseline x86-64.
int cell(float x) {
    const int i = int(x);
    return i - (x < float(i));
}

// A short hash: noise is most of a scene's cost.
float lattice(std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    std::uint32_t h = i * 0x8da6b343u ^ j * 0xd8163841u ^ k * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x9e3779b1u;
    return float((h ^ h >> 13) & 0xffffu) * 0x1p-15f - 1;
}

}  // namespace

float smoothstep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

float cell_value(int i, int j, std::uint32_t seed) {
    return float(hash(hash(std::uint32_t(i), std::uint32_t(j)), seed) >> 8) * 0x1p-24f;
}

float noise(Vec3 p) {
    const int cx = cell(p.x), cy = cell(p.y), cz = cell(p.z);
    const std::uint32_t i = std::uint32_t(cx), j = std::uint32_t(cy), k = std::uint32_t(cz);
    const auto fade = [](float t) { return t * t * (3 - 2 * t); };
    const float u = fade(p.x - float(cx)), v = fade(p.y - float(cy)), w = fade(p.z - float(cz));
    const auto edge = [&](std::uint32_t dj, std::uint32_t dk) {
        return mix(lattice(i, j + dj, k + dk), lattice(i + 1, j + dj, k + dk), u);
    };
    return mix(mix(edge(0, 0), edge(1, 0), v), mix(edge(0, 1), edge(1, 1), v), w);
}

float fractal_noise(Vec3 p, int octaves) {
    float sum = 0, strength = 1;
    for (int o = 0; o < octaves; ++o, strength *= 0.5f) {
        sum += strength * noise(p);
        p = 2.03f * p + Vec3{17.3f, 5.1f, 9.7f};
    }
    return sum;
}

float stripes(float x, float duty, float softness) {
    const float t = x - float(cell(x));
    return smoothstep(0, softness, t) * (1 - smoothstep(duty, duty + softness, t));
}

float checks(float x, float y, float softness) {
    const auto wave = [&](float t) {
        const float half = 2 * (0.5f * t - float(cell(0.5f * t)));  // 0…2
        return smoothstep(0, softness, half) - smoothstep(1, 1 + softness, half);
    };
    const float a = wave(x), b = wave(y);
    return a + b - 2 * a * b;
}

Brick brick(float x, float y, float joint_x, float joint_y) {
    const int row = cell(y);
    const float shifted = x + ((row & 1) ? 0.5f : 0.0f);
    const int column = cell(shifted);
    const auto inside = [](float t, float joint) {
        return smoothstep(0.3f * joint, joint, t) * smoothstep(0.3f * joint, joint, 1 - t);
    };
    return {1 - inside(shifted - float(column), joint_x) * inside(y - float(row), joint_y), column, row};
}

}  // namespace petzval::scene
