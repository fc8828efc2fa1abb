#include "scene/soft_depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::scene {
namespace {

// Weights of a Gaussian from its middle outwards to three standard deviations; both sides sum to 1.
std::vector<float> gaussian(double deviation_px) {
    std::vector<double> weights;
    for (int i = 0; i <= int(std::ceil(3 * deviation_px)); ++i)
        weights.push_back(std::exp(-0.5 * i * i / (deviation_px * deviation_px)));
    double sum = -weights[0];
    for (const double w : weights) sum += 2 * w;
    std::vector<float> shares;
    for (const double w : weights) shares.push_back(float(w / sum));
    return shares;
}

// Blurs along rows (dx = 1) or columns (dy = 1); beyond the border the last value continues.
Plane blurred(const Plane& in, const std::vector<float>& weights, int dx, int dy) {
    Plane out(in.width(), in.height());
    const auto at = [&](int x, int y) {
        return in(std::clamp(x, 0, in.width() - 1), std::clamp(y, 0, in.height() - 1));
    };
    for (int y = 0; y < in.height(); ++y)
        for (int x = 0; x < in.width(); ++x) {
            float sum = weights[0] * in(x, y);
            for (int i = 1; i < int(weights.size()); ++i)
                sum += weights[std::size_t(i)] * (at(x - i * dx, y - i * dy) + at(x + i * dx, y + i * dy));
            out(x, y) = sum;
        }
    return out;
}

template <typename Change>
void for_each_value(Plane& plane, const Change& change) {
    for (int y = 0; y < plane.height(); ++y)
        for (int x = 0; x < plane.width(); ++x) plane(x, y) = change(plane(x, y));
}

void quantise(Plane& plane, int bits) {
    float low = plane(0, 0), high = low;
    for_each_value(plane, [&](float v) {
        low = std::min(low, v), high = std::max(high, v);
        return v;
    });
    if (high <= low) return;
    const float last = float((1 << bits) - 1), step = (high - low) / last;
    for_each_value(plane, [&](float v) { return low + step * std::round((v - low) / step); });
}

}  // namespace

void soften_depth(Plane& depth_m, double blur_px, int bits) {
    if (blur_px <= 0 && bits <= 0) return;
    for_each_value(depth_m, [](float z) { return 1 / z; });
    if (blur_px > 0) {
        const std::vector<float> weights = gaussian(blur_px);
        depth_m = blurred(blurred(depth_m, weights, 1, 0), weights, 0, 1);
    }
    if (bits > 0) quantise(depth_m, bits);
    for_each_value(depth_m, [](float inverse) { return 1 / inverse; });
}

}  // namespace petzval::scene
