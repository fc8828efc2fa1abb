#include "glare/bloom.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::glare {
namespace {

// Halving and doubling, as BloomPlan has them, each spread light by this variance, in finer pixels squared.
constexpr double kResampleVariance = 0.75;
// Blurs narrower than this many pixels are made on the finer level, where the Gaussian is sampled well.
constexpr double kNarrowest_px = 1.5;

std::vector<float> gaussian(double sigma_px) {
    const int radius = std::max(1, int(std::ceil(4 * sigma_px)));
    std::vector<float> weights;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += std::exp(-0.5 * i * i / (sigma_px * sigma_px));
    for (int i = -radius; i <= radius; ++i)
        weights.push_back(float(std::exp(-0.5 * i * i / (sigma_px * sigma_px)) / sum));
    return weights;
}

// A blur on level `level` of the pyramid such that all steps together have the deviation sigma_px.
double sigma_on_level(double sigma_px, int level) {
    const double pixel = std::exp2(level);
    // Steps k = 0…level-1, down and up, on pixels of 2^k: 2 * 3/4 * sum 4^k.
    const double resampling = 2 * kResampleVariance * (pixel * pixel - 1) / 3;
    return std::sqrt(std::max(sigma_px * sigma_px - resampling, 1e-4)) / pixel;
}

// The coarsest level on which the blur is still at least kNarrowest_px wide.
int level_for(double sigma_px, int coarsest) {
    int level = 0;
    while (level < coarsest && sigma_on_level(sigma_px, level + 1) >= kNarrowest_px) ++level;
    return level;
}

}  // namespace

BloomPlan plan_bloom(double widest_px, double pixel_aspect) {
    BloomPlan plan;
    const double narrower = std::min(1.0, pixel_aspect);
    plan.coarsest = level_for(narrower * widest_px, 30);
    for (double sigma = widest_px; plan.blurs.empty() || sigma >= 0.8; sigma /= 2) {
        const int level = level_for(narrower * sigma, plan.coarsest);
        plan.blurs.push_back({level, gaussian(sigma_on_level(sigma, level)),
                              gaussian(sigma_on_level(sigma * pixel_aspect, level))});
    }
    return plan;
}

}  // namespace petzval::glare
