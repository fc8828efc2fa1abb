// From scene-linear light to what a display shows: exposure, tone curve, transfer function, dither, in this
// order.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"

#include <cstdint>
#include <vector>

namespace petzval {

// IEC 61966-2-1, exact piecewise form, odd-symmetric below 0. Values above 1 follow the power part.
PETZVAL_API double srgb_encode(double linear);
PETZVAL_API double srgb_decode(double encoded);

enum class ToneCurve {
    None,    // clip
    Filmic,  // neutral: mid-grey 0.18 kept, highlights roll off to 1 and pale, hue kept; see colour/tone.h
};

struct DevelopSettings {
    double exposure_stops = 0;
    ToneCurve tone = ToneCurve::Filmic;
    bool dither = true;  // triangular, one code value wide on either side, fixed pattern
    int bits = 8;        // 8 or 16
    int threads = 0;     // 0: all this process may use; the result never depends on it
};

// Interleaved RGB codes, 3 per pixel, row by row. The picture is shown over black: premultiplied colour as it
// is. NaN and negative light are black, infinite light is white.
PETZVAL_API std::vector<std::uint16_t> develop(View<const Rgba> picture,
                                               const DevelopSettings& settings = {});

}  // namespace petzval
