#include "engine/samples/white.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace petzval::engine {

float white_of(View<const Rgba> picture, Workers& workers) {
    // Rows are summed on their own, then in order: the same bits for any threads.
    std::vector<double> light(std::size_t(picture.height())), covered(std::size_t(picture.height()));
    parallel_for(picture.height(), workers, [&](int y) {
        const Rgba* const row = picture.row(y);
        double row_light = 0, row_covered = 0;
        for (int x = 0; x < picture.width(); ++x)
            row_light += double(std::max(0.0f, luminance(row[x]))), row_covered += double(row[x].a);
        light[std::size_t(y)] = row_light, covered[std::size_t(y)] = row_covered;
    });
    const double all_light = std::accumulate(light.begin(), light.end(), 0.0);
    const double all_covered = std::accumulate(covered.begin(), covered.end(), 0.0);
    const double mean = all_light / std::max(1.0, all_covered);
    return mean > 0 ? float(std::exp2(std::round(std::log2(4 * mean)))) : 0.0f;
}

}  // namespace petzval::engine
