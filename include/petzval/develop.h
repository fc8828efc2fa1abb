// Conversion of scene-linear light to display codes: exposure, contrast, tone curve, transfer function,
// dither, in this order.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/workers.h"

#include <cstdint>
#include <vector>

namespace petzval {

// IEC 61966-2-1, exact piecewise form, odd-symmetric below 0. Values above 1 follow the power part.
PETZVAL_API double srgb_encode(double linear);
PETZVAL_API double srgb_decode(double encoded);

// Meaning of codes of 0…1 as light.
enum class Transfer {
    Srgb,     // IEC 61966-2-1
    Gamma22,  // light = code^2.2: displays of the plain power kind
    Gamma20,  // light = code^2: the cheap approximation of games
    Linear,   // light = code: mattes, and linear 8-bit textures, which have few codes in the dark
};

// Odd-symmetric below 0.
PETZVAL_API double encode(Transfer transfer, double linear);
PETZVAL_API double decode(Transfer transfer, double code);

enum class ToneCurve {
    None,      // clip
    Reinhard,  // n / (1 + n) on the largest channel: simple, never clips, mid-grey falls to 0.15
    Filmic,    // neutral: mid-grey 0.18 kept, highlights roll off to 1 and pale, hue kept; see colour/tone.h
};

struct DevelopSettings {
    double exposure_stops = 0;
    // Exponent about mid-grey 0.18, on the largest channel, hue kept; before the tone curve. 1: unchanged.
    // Check the scene's range first (measure_dynamic_range), then change contrast.
    double contrast = 1;
    ToneCurve tone = ToneCurve::Filmic;
    Transfer transfer = Transfer::Srgb;
    bool dither = true;          // triangular, one code value wide on either side, fixed pattern
    int bits = 8;                // 8 or 16
    bool alpha = false;          // a fourth code a pixel: coverage as it is, rounded
    int threads = 0;             // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;  // those of a host, in place of `threads`; null: our own
};

// Interleaved codes, 3 per pixel or 4 with alpha, row by row. The picture is shown over black: premultiplied
// colour as it is. NaN and negative light are black, infinite light is white.
PETZVAL_API std::vector<std::uint16_t> develop(View<const Rgba> picture,
                                               const DevelopSettings& settings = {});

}  // namespace petzval
