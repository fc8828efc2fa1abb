#include "scene/textures.h"

#include "scene/sampling.h"

namespace petzval::scene {
namespace {

float lattice(int i, int j, int k) {
    const std::uint32_t h = hash(hash(std::uint32_t(i), std::uint32_t(j)), std::uint32_t(k));
    return float(h >> 8) * 0x1p-23f - 1;
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
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    const int i = int(fx), j = int(fy), k = int(fz);
    const auto fade = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const float u = fade(p.x - fx), v = fade(p.y - fy), w = fade(p.z - fz);
    const auto edge = [&](int dj, int dk) {
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
    const float t = x - std::floor(x);
    return smoothstep(0, softness, t) * (1 - smoothstep(duty, duty + softness, t));
}

float checks(float x, float y, float softness) {
    const auto wave = [&](float t) {
        const float half = 2 * (0.5f * t - std::floor(0.5f * t));  // 0…2
        return smoothstep(0, softness, half) - smoothstep(1, 1 + softness, half);
    };
    const float a = wave(x), b = wave(y);
    return a + b - 2 * a * b;
}

Brick brick(float x, float y, float joint_x, float joint_y) {
    const float row = std::floor(y);
    const float shifted = x + 0.5f * std::fmod(std::abs(row), 2.0f);
    const float column = std::floor(shifted);
    const auto inside = [](float t, float joint) {
        return smoothstep(0.3f * joint, joint, t) * smoothstep(0.3f * joint, joint, 1 - t);
    };
    return {1 - inside(shifted - column, joint_x) * inside(y - row, joint_y), int(column), int(row)};
}

}  // namespace petzval::scene
