// Measures the dynamic range of a picture and restores clipped highlights. Blur makes missing range visible,
// because light that is spread over a disc of radius r becomes pi r^2 times darker.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

// Luminance statistics (Rec.709) of all pixels that are not black; levels are percentiles.
struct DynamicRange {
    double shadow = 0, middle = 0, diffuse = 0, specular = 0;  // 5, 50, 90 and 99.9 % of pixels are darker
    double brightest = 0;                                      // largest channel
    double diffuse_over_shadow_stops = 0, specular_over_diffuse_stops = 0;
    std::string comparison;    // diffuse over shadow beside the ratios of real light, one line
    double black_share = 0;    // pixels without light, of all
    double clipped_share = 0;  // pixels with a channel at the top of the format, of all: 1 where nothing is
                               // above it, or 65504
    // Nothing is above 1 and either the codes are those of 8 bits, or half of the picture is above 0.25 while
    // diffuse and shadow are half a stop to 4 stops apart: as sRGB codes would look if they were taken for
    // light.
    bool looks_encoded = false;
    // Sentences for the user: the picture looks encoded, its highlights are clipped, and how either changes
    // blur.
    std::vector<std::string> advice;
};

// display_referred: the picture was decoded from display codes, so that it cannot be encoded light.
PETZVAL_API DynamicRange measure_dynamic_range(View<const Rgba> picture, bool display_referred);

// The assumption for expanding a plate's highlights: light up to the knee was recorded unchanged, and above
// it a shoulder mapped `peak` to 1. With s = (v - knee)/(1 - knee) on the largest channel,
//     light = knee + (1 - knee) s / (1 - b s),   b = 1 - (1 - knee)/(peak - knee),
// which leaves the knee with slope 1, without a joint. Hue is kept. What is above 1 is `peak` times itself.
struct HighlightExpansion {
    double knee = 0.5;  // 0 … 1
    double peak = 16;   // > 1: four stops above diffuse white

    bool operator==(const HighlightExpansion&) const = default;
};

// Errors: InvalidArgument for numbers out of range, or if the picture holds light above 1.05: it is not a
// plate of low range.
PETZVAL_API Result<Picture> expand_highlights(View<const Rgba> plate, const HighlightExpansion& expansion);

// The way back, after the blur. A pixel that the blur left alone, equal to that of `expanded`, is the plate's
// own, bit for bit. Requires: three pictures of one size and the numbers that made `expanded`.
PETZVAL_API Picture compress_highlights(View<const Rgba> blurred, View<const Rgba> expanded,
                                        View<const Rgba> plate, const HighlightExpansion& expansion);

}  // namespace petzval
