// From a file's colour primaries to Rec.709 / D65 and back.
#pragma once

#include "petzval/image.h"

#include "files/layout.h"

#include <array>
#include <optional>

namespace petzval {

// Row-major; multiplies a column of R, G, B.
using Matrix3 = std::array<double, 9>;

using Chromaticity = std::array<double, 2>;

struct PrimariesConversion {
    Matrix3 to_rec709, from_rec709;
    std::optional<Chromaticity> adapted_from;  // the neutral that became D65; nothing where none was adapted
};

// Nothing when the primaries are those of Rec.709 (to 1e-3) and neutral is D65, or when they describe no
// colour space. What is neutral becomes D65 (Bradford adaptation): `neutral` (OpenEXR's adoptedNeutral) where
// it is given, else the white of the primaries; but for an encoding of CIE XYZ, whose white E is no light
// that anybody saw, and which is taken as it is.
std::optional<PrimariesConversion> conversion_of(const Chromaticities& primaries,
                                                 std::optional<Chromaticity> neutral = {});
bool is_rec709(const Chromaticities& primaries);
// X, Y and Z themselves.
bool is_xyz(const Chromaticities& primaries);

inline Rgba transformed(const Matrix3& m, Rgba c) {
    const double r = c.r, g = c.g, b = c.b;
    return {float(m[0] * r + m[1] * g + m[2] * b), float(m[3] * r + m[4] * g + m[5] * b),
            float(m[6] * r + m[7] * g + m[8] * b), c.a};
}

}  // namespace petzval
