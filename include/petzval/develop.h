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
    Filmic,  // neutral shoulder: mid-grey 0.18 kept, highlights roll off to 1 without a hue shift
};

struct DevelopSettings {
    double exposure_stops = 0;
    ToneCurve tone = ToneCurve::Filmic;
    bool dither = true;  // triangular, one code value wide on either side, fixed pattern
    int bits = 8;        // 8 or 16
};

// Interleaved RGB codes, 3 per pixel, row by row. The picture is shown over black.
PETZVAL_API std::vector<std::uint16_t> develop(View<const Rgba> picture,
                                               const DevelopSettings& settings = {});

}  // namespace petzval
