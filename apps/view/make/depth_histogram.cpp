#include "depth_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace petzval::view {

DepthHistogram histogram_of(const Shot& shot) {
    constexpr int kSteps = 160;
    DepthHistogram histogram;
    const auto* depth = std::get_if<DepthMetres>(&shot.depth);
    if (!depth || depth->plane.empty()) return histogram;
    const float* all = depth->plane.pixels();
    const std::size_t count = depth->plane.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!(all[i] > 0) || std::isinf(all[i])) {
            histogram.has_misses = true;
            continue;
        }
        const double z = double(all[i]);
        histogram.nearest_m = histogram.nearest_m > 0 ? std::min(histogram.nearest_m, z) : z;
        histogram.farthest_m = std::max(histogram.farthest_m, z);
    }
    if (histogram.farthest_m <= 0) return {};
    if (histogram.farthest_m < 1.01 * histogram.nearest_m)  // a wall: give it a width
        histogram.nearest_m *= 0.9, histogram.farthest_m *= 1.1;
    histogram.counts.assign(kSteps, 0);
    for (std::size_t i = 0; i < count; ++i)
        if (all[i] > 0 && !std::isinf(all[i])) {
            const int at = int(histogram.share_of(double(all[i])) * kSteps);
            histogram.counts[std::size_t(std::clamp(at, 0, kSteps - 1))] += 1;
        }
    const float most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    for (float& n : histogram.counts) n /= most;
    return histogram;
}

double DepthHistogram::distance_at(double share) const {
    return nearest_m * std::pow(farthest_m / nearest_m, share);
}
double DepthHistogram::share_of(double distance_m) const {
    return std::log(distance_m / nearest_m) / std::log(farthest_m / nearest_m);
}

}  // namespace petzval::view
