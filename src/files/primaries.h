// Conversion between a file's colour primaries and Rec.709 / D65.
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

// Nothing if the primaries are those of Rec.709 (to 1e-3) and neutral is D65, or if they describe no colour
// space. Neutral becomes D65 (Bradford adaptation): `neutral` (OpenEXR's adoptedNeutral) if given, otherwise
// the white of the primaries. CIE XYZ encodings are the exception: their white E is not real light, so they
// are used unchanged.
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
