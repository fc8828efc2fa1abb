// From a file's colour primaries to Rec.709 / D65 and back.
#pragma once

#include "petzval/image.h"

#include "files/layout.h"

#include <array>
#include <optional>

namespace petzval {

// Row-major; multiplies a column of R, G, B.
using Matrix3 = std::array<double, 9>;

struct PrimariesConversion {
    Matrix3 to_rec709, from_rec709;
};

// Nothing when the primaries are those of Rec.709 (to 1e-3) or describe no colour space.
// White goes to white (Bradford adaptation), so that neutral stays neutral.
std::optional<PrimariesConversion> conversion_of(const Chromaticities& primaries);
bool is_rec709(const Chromaticities& primaries);

inline Rgba transformed(const Matrix3& m, Rgba c) {
    const double r = c.r, g = c.g, b = c.b;
    return {float(m[0] * r + m[1] * g + m[2] * b), float(m[3] * r + m[4] * g + m[5] * b),
            float(m[6] * r + m[7] * g + m[8] * b), c.a};
}

}  // namespace petzval
