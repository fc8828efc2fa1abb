#include "engine/gaussian/plan.h"

#include "engine/waist/cells.h"

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
    const double splines = level > 0 ? 2 * CellSplines::kVariance : 0;
    return std::sqrt(std::max(0.0, sigma_px * sigma_px / (s * s) - splines));
}

// Weights at -radius…radius that sum to 1 and whose variance is that asked for: a cut Gaussian is narrower
// than a whole one, so it starts from a wider.
std::vector<float> gaussian_weights(double sigma) {
    const int radius = std::max(1, int(std::ceil(3 * sigma)));
    std::vector<double> weights(std::size_t(2 * radius + 1));
    double wider = std::max(sigma, 0.05);
    for (int pass = 0; pass < 16; ++pass) {
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

// Share of a kernel inside the picture at each cell; cells at the ends may lie inside in part.
std::vector<float> share_inside(const std::vector<float>& weights, int level, int cells, int pixels) {
    const int radius = int(weights.size() / 2);
    const CellSplines splines(level, cells);
    std::vector<float> inside(std::size_t(cells), 0.0f), shares = inside;
    for (int x = 0; x < pixels; ++x)
        for (int k = 0; k < 3; ++k)
            inside[std::size_t(splines.cell(x, k))] += std::ldexp(splines.shares(x)[std::size_t(k)], -level);
    for (int i = 0; i < cells; ++i)
        for (int k = std::max(0, i - radius); k <= std::min(cells - 1, i + radius); ++k)
            shares[std::size_t(i)] += weights[std::size_t(k - i + radius)] * inside[std::size_t(k)];
    return shares;
}

BlurAxis axis_of(std::vector<float> weights, int level, int pixels) {
    const int cells = (pixels + (1 << level) - 1) >> level;
    std::vector<float> inside = share_inside(weights, level, cells, pixels);
    return {std::move(weights), std::move(inside)};
}

BlurAxis axis(double sigma_px, int level, int pixels) {
    return axis_of(gaussian_weights(sigma_in_cells(sigma_px, level)), level, pixels);
}

// On cells so small that columns stay as they are: pixels, up to radii of some 270 px. It takes hundreds of
// weights for wide ones; nobody looks at it but to see how the blur is made.
Blur blur_of_rows(double radius_px, double pixel_aspect, int width, int height) {
    const int level = std::max(0, blur_level(radius_px, pixel_aspect) - 6);
    return {level, axis(sigma_of(radius_px), level, width), axis_of({1}, level, height)};
}

void plan_layers(const EngineView& input, float band_px, GaussianPlan& plan) {
    plan.near = BlurStack(-input.samples.nearest_coc_px, band_px);
    plan.far = BlurStack(input.samples.farthest_coc_px, band_px);
    const auto add = [&](float radius_px) {
        plan.blurs.push_back(
            blur_of(double(radius_px), input.lens.pixel_aspect, input.width(), input.height()));
    };
    for (int k = plan.near.count(); k > 0; --k) add(plan.near.radius_px(k));
    for (int k = 1; k <= plan.far.count(); ++k) add(plan.far.radius_px(k));
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

GaussianPlan plan_gaussian(const EngineView& input) {
    const GaussianOptions& options = input.options.of<GaussianOwn>().gaussian;
    const float largest_px = std::max(-input.samples.nearest_coc_px, input.samples.farthest_coc_px);
    const float band_px = float(options.focus_band.value_or(0));
    GaussianPlan plan;
    plan.view = options.view, plan.colour = input.samples.colour, plan.coc_px = input.samples.coc_px;
    if (options.style == GaussianStyle::Layered && options.view == GaussianView::Result) {
        plan_layers(input, band_px, plan);
        EngineView front = input;
        front.samples.plate = {};
        plan.surfaces = preview_surfaces(front, input.options.fill != Fill::Off);
        return plan;
    }
    const auto add = [&](float radius_px) {
        plan.blurs.push_back(
            blur_of(double(radius_px), input.lens.pixel_aspect, input.width(), input.height()));
    };
    plan.far = BlurStack(largest_px, band_px);
    if (options.style == GaussianStyle::Wgld) {
        plan.law = GaussianPlan::Law::ByDepth, plan.depth = DepthMix(input, largest_px);
    } else {
        plan.law = GaussianPlan::Law::ByRadius;
        if (options.view == GaussianView::Result) {
            for (int k = 1; k <= plan.far.count(); ++k) add(plan.far.radius_px(k));
            return plan;
        }
    }
    add(largest_px / 2), add(largest_px);
    if (plan.view == GaussianView::BlurRows)
        plan.blurs[GaussianPlan::kLarge] =
            blur_of_rows(largest_px, input.lens.pixel_aspect, input.width(), input.height());
    return plan;
}

}  // namespace petzval::engine
