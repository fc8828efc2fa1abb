// The matrix of a set of primaries: SMPTE RP 177-1993. Chromatic adaptation: the linear Bradford transform of
// the ICC specification (ICC.1:2022, annex E).
#include "files/primaries.h"

#include <algorithm>
#include <cmath>

namespace petzval {
namespace {

constexpr Chromaticities kRec709{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
constexpr Matrix3 kBradford{0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296};

Matrix3 product(const Matrix3& p, const Matrix3& q) {
    Matrix3 out{};
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            for (std::size_t i = 0; i < 3; ++i) out[row * 3 + column] += p[row * 3 + i] * q[i * 3 + column];
    return out;
}

std::array<double, 3> product(const Matrix3& m, const std::array<double, 3>& v) {
    return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2],
            m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

std::optional<Matrix3> inverse(const Matrix3& m) {
    const Matrix3 cofactors{m[4] * m[8] - m[5] * m[7], m[2] * m[7] - m[1] * m[8], m[1] * m[5] - m[2] * m[4],
                            m[5] * m[6] - m[3] * m[8], m[0] * m[8] - m[2] * m[6], m[2] * m[3] - m[0] * m[5],
                            m[3] * m[7] - m[4] * m[6], m[1] * m[6] - m[0] * m[7], m[0] * m[4] - m[1] * m[3]};
    const double determinant = m[0] * cofactors[0] + m[1] * cofactors[3] + m[2] * cofactors[6];
    if (!(std::abs(determinant) > 1e-9)) return std::nullopt;
    Matrix3 out = cofactors;
    for (double& v : out) v /= determinant;
    return out;
}

// Tristimulus values of a chromaticity, Y = 1.
std::array<double, 3> xyz_of(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

std::optional<Matrix3> xyz_from_rgb(const Chromaticities& c) {
    Matrix3 primaries{};
    for (std::size_t i = 0; i < 3; ++i) {
        primaries[i] = c[2 * i], primaries[3 + i] = c[2 * i + 1];
        primaries[6 + i] = 1 - c[2 * i] - c[2 * i + 1];
    }
    const std::optional<Matrix3> inverted = inverse(primaries);
    if (!inverted || !(std::abs(c[7]) > 1e-6)) return std::nullopt;
    const std::array<double, 3> strength = product(*inverted, xyz_of(c[6], c[7]));
    for (std::size_t i = 0; i < 9; ++i) primaries[i] *= strength[i % 3];
    return primaries;
}

// Matrix from colours under that light to the same colours under D65.
std::optional<Matrix3> adaptation(const Chromaticity& neutral) {
    const auto from = product(kBradford, xyz_of(neutral[0], neutral[1]));
    const auto to = product(kBradford, xyz_of(kRec709[6], kRec709[7]));
    if (!std::all_of(from.begin(), from.end(),
                     [](double v) { return std::abs(v) > 1e-6 && std::isfinite(v); }))
        return std::nullopt;
    const Matrix3 gain{to[0] / from[0], 0, 0, 0, to[1] / from[1], 0, 0, 0, to[2] / from[2]};
    return product(*inverse(kBradford), product(gain, kBradford));
}

bool is_d65(const Chromaticity& c) {
    return std::abs(c[0] - kRec709[6]) <= 1e-3 && std::abs(c[1] - kRec709[7]) <= 1e-3;
}

}  // namespace

bool is_rec709(const Chromaticities& primaries) {
    for (std::size_t i = 0; i < primaries.size(); ++i)
        if (std::abs(primaries[i] - kRec709[i]) > 1e-3) return false;
    return true;
}

bool is_xyz(const Chromaticities& primaries) {
    constexpr Chromaticities kXyz{1, 0, 0, 1, 0, 0, 1. / 3, 1. / 3};
    for (std::size_t i = 0; i < primaries.size(); ++i)
        if (std::abs(primaries[i] - kXyz[i]) > 1e-3) return false;
    return true;
}

std::optional<PrimariesConversion> conversion_of(const Chromaticities& primaries,
                                                 std::optional<Chromaticity> neutral) {
    const bool finite =
        std::all_of(primaries.begin(), primaries.end(), [](double v) { return std::isfinite(v); });
    if (!neutral && !is_xyz(primaries)) neutral = Chromaticity{primaries[6], primaries[7]};
    if (neutral && is_d65(*neutral)) neutral.reset();
    if (!finite || (is_rec709(primaries) && !neutral)) return std::nullopt;
    const std::optional<Matrix3> to_xyz = xyz_from_rgb(primaries);
    const std::optional<Matrix3> adapt = neutral ? adaptation(*neutral) : Matrix3{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (!to_xyz || !adapt) return std::nullopt;
    const Matrix3 rec709_from_xyz = *inverse(*xyz_from_rgb(kRec709));
    const Matrix3 to_rec709 = product(rec709_from_xyz, product(*adapt, *to_xyz));
    const std::optional<Matrix3> back = inverse(to_rec709);
    if (!back) return std::nullopt;
    return PrimariesConversion{to_rec709, *back, neutral};
}

}  // namespace petzval
