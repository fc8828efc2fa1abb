// Differences between pictures, by the measures of docs/reference/report.md.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <vector>

namespace petzval {

struct CompareSettings {
    double exposure = 1;          // linear factor before clipping
    View<const float> mask = {};  // pixels above 0.5 count; empty: all pixels
    int threads = 0;              // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;   // those of a host, in place of `threads`; null: our own
};

// dB for psnr_*, peak 1; identical pictures give +infinity.
struct Comparison {
    double psnr_lin = 0;   // linear x exposure, clipped to 0…1, over R, G, B
    double psnr_srgb = 0;  // the same after the sRGB curve
    double psnr_log = 0;   // log2(1 + x/0.18), x clipped to 0…64, divided by its value at 64
    double ssim_lin =
        0;  // Wang et al. 2004, 11 x 11 Gaussian sigma 1.5, Rec.709 luma of clipped values, L = 1
    double ssim_srgb = 0;
    double max_error = 0;  // largest |difference| of a clipped linear channel
    int max_error_x = 0, max_error_y = 0;
    double energy_ratio = 0;  // sum of test / sum of reference, unclipped, R + G + B
};

// Errors: InvalidArgument when sizes differ, a picture or the mask is empty.
PETZVAL_API Result<Comparison> compare(View<const Rgba> reference, View<const Rgba> test,
                                       const CompareSettings& settings = {});

// A square of a picture that differs more than its surroundings.
struct WorstPlace {
    Rect area;
    double rms = 0;  // of R, G, B as sRGB codes 0…1
};

struct Difference {
    Plane error;  // largest |difference| of R, G, B as sRGB codes 0…1; 0 where the mask does not count
    std::vector<WorstPlace> worst;  // squares that differ, the worst first; no two touch
};

// The pixels and places that differ. The squares are 1/24 of the longer side, at least 8 pixels. Errors:
// those of compare().
PETZVAL_API Result<Difference> difference(View<const Rgba> reference, View<const Rgba> test,
                                          const CompareSettings& settings = {}, int most_places = 5);

}  // namespace petzval
