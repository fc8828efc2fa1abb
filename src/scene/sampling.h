// Evenly spread sample points in four dimensions, scrambled apart from pixel to pixel.
//
// Sobol' points with the direction numbers of S. Joe and F. Y. Kuo ("Constructing Sobol sequences with better
// two-dimensional projections", SIAM J. Sci. Comput. 30, 2008), Owen-scrambled by hashing as in B. Burley,
// "Practical Hash-based Owen Scrambling", Journal of Computer Graphics Techniques 9(4), 2020.
#pragma once

#include "scene/vec3.h"

#include <array>
#include <cstdint>
#include <vector>

namespace petzval::scene {

// A well mixed 32-bit number from two.
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = a * 0x9e3779b9u ^ (b + 0x7f4a7c15u + (a << 6) + (a >> 2));
    x ^= x >> 16, x *= 0x7feb352du;
    x ^= x >> 15, x *= 0x846ca68bu;
    return x ^ x >> 16;
}

using Point4 = std::array<float, 4>;  // each in [0, 1); the first two dimensions are the best spread pair

// The first `count` points of the sequence; thread-safe once made.
class SobolPoints {
public:
    explicit SobolPoints(int count);
    int count() const { return int(points_.size()); }
    // Point i of the sequence scrambled by `seed`: every aligned run of 2^k points stays evenly spread.
    Point4 at(int i, std::uint32_t seed) const;

private:
    std::vector<std::array<std::uint32_t, 4>> points_;  // bits reversed: most significant digit last
};

// Area-preserving map of the unit square to the unit disc (P. Shirley and K. Chiu, "A low distortion map
// between disk and square", Journal of Graphics Tools 2(3), 1997).
struct DiscPoint {
    float x = 0, y = 0;
};
DiscPoint disc_point(float u, float v);

// Direction around `normal` with density cos(angle) / pi.
Vec3 cosine_direction(Vec3 normal, float u, float v);

}  // namespace petzval::scene
