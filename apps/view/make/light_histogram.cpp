#include "light_histogram.h"

#include <algorithm>
#include <cmath>

namespace petzval::view {

LightHistogram histogram_of(View<const Rgba> picture) {
    constexpr int kSteps = 108;  // six a stop
    LightHistogram histogram;
    for (auto& channel : histogram.counts) channel.assign(kSteps, 0);
    const int by = std::max(1, int(std::sqrt(double(picture.width()) * picture.height() / 100'000)));
    double seen = 0;
    for (int y = by / 2; y < picture.height(); y += by)
        for (int x = by / 2; x < picture.width(); x += by) {
            const Rgba& pixel = picture.row(y)[x];
            const std::array<float, 3> light{pixel.r, pixel.g, pixel.b};
            const float most = std::max({pixel.r, pixel.g, pixel.b});
            ++seen;
            histogram.black += most > 0 ? 0 : 1;
            histogram.above_white += most > 1 ? 1 : 0;
            for (std::size_t c = 0; c < 3; ++c) {
                if (!(light[c] > 0) || std::isinf(light[c])) continue;
                const double share = (std::log2(double(light[c])) - LightHistogram::kLowest_stops) /
                                     (LightHistogram::kHighest_stops - LightHistogram::kLowest_stops);
                histogram.counts[c][std::size_t(std::clamp(int(share * kSteps), 0, kSteps - 1))] += 1;
            }
        }
    float most = 1;
    for (const auto& channel : histogram.counts)
        most = std::max(most, *std::max_element(channel.begin(), channel.end()));
    for (auto& channel : histogram.counts)
        for (float& n : channel) n /= most;
    histogram.black /= std::max(seen, 1.0);
    histogram.above_white /= std::max(seen, 1.0);
    return histogram;
}

}  // namespace petzval::view
