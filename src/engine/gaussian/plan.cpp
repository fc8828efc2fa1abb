#include "engine/gaussian/plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

constexpr double kLeastSigmaCells = 0.8;

// A disc of radius r has the variance r^2/4 per axis, and a pixel 1/12.
double sigma_of(double radius_px) { return std::sqrt(radius_px * radius_px / 4 + 1.0 / 12); }

double sigma_in_cells(double sigma_px, int level) {
    const double s = std::ldexp(1.0, level);
    return std::sqrt(std::max(0.0, sigma_px * sigma_px - (level > 0 ? s * s / 4 : 0))) / s;
}

// Weights at -radius…radius that sum to 1 and whose variance is that asked for: a cut Gaussian is narrower
// than a whole one, so it starts from a wider.
std::vector<float> gaussian_weights(double sigma) {
    const int radius = std::max(1, int(std::ceil(3 * sigma)));
    std::vector<double> weights(std::size_t(2 * radius + 1));
    double wider = std::max(sigma, 0.05);
    for (int pass = 0; pass < 4; ++pass) {
        double sum = 0, moment = 0;
        for (int k = -radius; k <= radius; ++k) {
            const double w = std::exp(-0.5 * k * k / (wider * wider));
            weights[std::size_t(k + radius)] = w;
            sum += w, moment += w * k * k;
        }
        for (double& w : weights) w /= sum;
        if (moment > 0) wider *= std::clamp(sigma / std::sqrt(moment / sum), 0.5, 2.0);
    }
    return {weights.begin(), weights.end()};
}

// How much of a kernel at each of n cells lies inside; the last cell may lie inside in part.
std::vector<float> share_inside(const std::vector<float>& weights, int cells, int level, int pixels) {
    const int radius = int(weights.size() / 2), size = 1 << level;
    std::vector<float> shares(std::size_t(cells), 0.0f);
    for (int i = 0; i < cells; ++i)
        for (int k = std::max(0, i - radius); k <= std::min(cells - 1, i + radius); ++k)
            shares[std::size_t(i)] +=
                weights[std::size_t(k - i + radius)] * float(std::min(size, pixels - k * size)) / float(size);
    return shares;
}

BlurAxis axis(double sigma_px, int level, int pixels) {
    std::vector<float> weights = gaussian_weights(sigma_in_cells(sigma_px, level));
    const int cells = (pixels + (1 << level) - 1) >> level;
    std::vector<float> inside = share_inside(weights, cells, level, pixels);
    return {std::move(weights), std::move(inside)};
}

void plan_layers(const Input& input, float band_px, GaussianPlan& plan) {
    plan.near = RadiusMix(-input.nearest_coc_px, band_px);
    plan.far = RadiusMix(input.farthest_coc_px, band_px);
    plan.blurs.resize(GaussianPlan::kBackdrop + 1);
    const auto add = [&](GaussianPlan::LayeredBlur blur, float radius_px) {
        plan.blurs[blur] = blur_of(double(radius_px), input.pixel_aspect, input.width(), input.height());
    };
    if (plan.near.blurs()) {
        add(GaussianPlan::kNearLarge, plan.near.large_px());
        add(GaussianPlan::kNearSmall, plan.near.small_px());
        add(GaussianPlan::kBackdrop, std::max(plan.near.small_px(), 1.0f));
    }
    if (plan.far.blurs()) {
        add(GaussianPlan::kFarSmall, plan.far.small_px());
        add(GaussianPlan::kFarLarge, plan.far.large_px());
    }
}

}  // namespace

int blur_level(double radius_px, double pixel_aspect) {
    const double least = std::min(sigma_of(radius_px), sigma_of(radius_px * pixel_aspect));
    int level = 0;
    while (level < 14 && sigma_in_cells(least, level + 1) >= kLeastSigmaCells) ++level;
    return level;
}

Blur blur_of(double radius_px, double pixel_aspect, int width, int height) {
    const int level = blur_level(radius_px, pixel_aspect);
    return {level, axis(sigma_of(radius_px), level, width),
            axis(sigma_of(radius_px * pixel_aspect), level, height)};
}

GaussianPlan plan_gaussian(const Input& input) {
    const GaussianOptions& options = input.gaussian;
    const float largest_px = std::max(-input.nearest_coc_px, input.farthest_coc_px);
    const float band_px = float(options.focus_band.value_or(0));
    GaussianPlan plan;
    plan.view = options.view, plan.colour = input.colour, plan.coc_px = input.coc_px;
    if (options.style == GaussianStyle::Layered && options.view == GaussianView::Result) {
        plan_layers(input, band_px, plan);
        return plan;
    }
    for (const float radius_px : {largest_px / 2, largest_px})
        plan.blurs.push_back(blur_of(double(radius_px), input.pixel_aspect, input.width(), input.height()));
    if (options.style == GaussianStyle::Wgld)
        plan.law = GaussianPlan::Law::ByDepth, plan.depth = DepthMix(input, largest_px);
    else
        plan.law = GaussianPlan::Law::ByRadius, plan.far = RadiusMix(largest_px, band_px);
    return plan;
}

}  // namespace petzval::engine
