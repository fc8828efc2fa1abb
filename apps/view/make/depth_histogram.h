// Distribution of the distances in a picture.
#pragma once

#include "petzval/shot.h"

#include <vector>

namespace petzval::view {

// Number of pixels per distance, on a logarithmic scale.
struct DepthHistogram {
    double nearest_m = 0, farthest_m = 0;  // finite ones; both 0: there is no depth in metres
    std::vector<float> counts;             // even steps of the logarithm between; share of the fullest
    bool has_misses = false;

    double distance_at(double share) const;  // 0…1 of the scale
    double share_of(double distance_m) const;
};
DepthHistogram histogram_of(const Shot& shot);

}  // namespace petzval::view
