// The samples of one deep pixel: overlapping volumes separated and cut into thin ones, crowds summed up.
#pragma once

#include "petzval/deep.h"

#include <span>
#include <vector>

namespace petzval {

// Pixels of more samples than this are summed up.
constexpr std::size_t kCrowdedSamples = 256;

// Appends the same light to `out` with no sample overlapping another: volumes are split wherever another
// sample of the pixel begins or ends and at each of the depths `cuts_m` (ascending), and the parts that fill
// the same interval are mixed. Part t of a volume of coverage A covers 1 - (1 - A)^t, its colour goes in
// proportion. A volume without an end is taken at its front. A crowded pixel becomes one sample per interval
// between cuts, at its mean depth as seen. Requires: nearest first, no NaN.
void tidy_pixel(std::span<const DeepSample> pixel, std::span<const float> cuts_m,
                std::vector<DeepSample>& out);

// True if any sample lies inside a volume of the same pixel.
bool has_overlaps(std::span<const DeepSample> pixel);

}  // namespace petzval
