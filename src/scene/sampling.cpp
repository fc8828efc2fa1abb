#include "scene/sampling.h"

namespace petzval::scene {
namespace {

std::uint32_t reversed_bits(std::uint32_t x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    return __builtin_bswap32(x);
}

// Each bit changes depending on the lower bits alone: an Owen scramble of a number whose digits are reversed.
std::uint32_t scrambled(std::uint32_t reversed, std::uint32_t seed) {
    std::uint32_t x = reversed + seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

// Direction numbers of one dimension: degree s, coefficients a and initial m of its primitive polynomial.
std::array<std::uint32_t, 32> directions(unsigned s, unsigned a, std::array<std::uint32_t, 3> m) {
    std::array<std::uint32_t, 32> v{};
    for (unsigned i = 0; i < 32; ++i) {
        if (s == 0) {
            v[i] = 1u << (31 - i);  // first dimension: van der Corput
        } else if (i < s) {
            v[i] = m[i] << (31 - i);
        } else {
            v[i] = v[i - s] ^ (v[i - s] >> s);
            for (unsigned k = 1; k < s; ++k)
                if (a >> (s - 1 - k) & 1u) v[i] ^= v[i - k];
        }
    }
    return v;
}

}  // namespace

SobolPoints::SobolPoints(int count) : points_(std::size_t(count)) {
    const std::array<std::array<std::uint32_t, 32>, 4> v = {
        directions(0, 0, {}), directions(1, 0, {1}), directions(2, 1, {1, 3}), directions(3, 1, {1, 3, 1})};
    for (std::size_t i = 0; i < points_.size(); ++i)
        for (std::size_t d = 0; d < 4; ++d) {
            std::uint32_t x = 0;
            for (std::size_t bit = 0; bit < 32; ++bit)
                if (i >> bit & 1u) x ^= v[d][bit];
            points_[i][d] = reversed_bits(x);
        }
}

Point4 SobolPoints::at(int i, std::uint32_t seed) const {
    Point4 point;
    for (std::size_t d = 0; d < 4; ++d) {
        const std::uint32_t x = scrambled(points_[std::size_t(i)][d], hash(seed, std::uint32_t(d)));
        point[d] = float(reversed_bits(x) >> 8) * 0x1p-24f;
    }
    return point;
}

DiscPoint disc_point(float u, float v) {
    const float a = 2 * u - 1, b = 2 * v - 1;
    if (a == 0 && b == 0) return {};
    const bool wide = std::abs(a) > std::abs(b);
    const float radius = wide ? a : b;
    const float angle = wide ? kPi / 4 * (b / a) : kPi / 2 - kPi / 4 * (a / b);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vec3 cosine_direction(Vec3 normal, float u, float v) {
    // A frame that turns smoothly with the normal (J. R. Frisvad, "Building an orthonormal basis from a 3D
    // unit vector without normalization", Journal of Graphics Tools 16(3), 2012), singular straight down
    // only.
    if (normal.y < -0.9999f) normal = {0, -0.9999f, 0.01414f};
    const float a = 1 / (1 + normal.y), b = -normal.x * normal.z * a;
    const Vec3 tangent{1 - normal.x * normal.x * a, -normal.x, b};
    const Vec3 bitangent{b, -normal.z, 1 - normal.z * normal.z * a};
    const DiscPoint p = disc_point(u, v);
    const float height = std::sqrt(std::max(0.0f, 1 - p.x * p.x - p.y * p.y));
    return p.x * tangent + p.y * bitangent + height * normal;
}

}  // namespace petzval::scene
