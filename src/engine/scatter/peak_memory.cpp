#include "engine/scatter/peak_memory.h"

#include "base/parallel.h"
#include "engine/samples/silhouettes/count.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace petzval::engine {
namespace {

// The sum of value(x, y) over a picture.
template <typename Value>
double sum_of(const Rect& pixels, Workers& workers, const Value& value) {
    std::vector<double> rows(std::size_t(pixels.height()));
    parallel_for(pixels.height(), workers, [&](int y) {
        for (int x = 0; x < pixels.width(); ++x) rows[std::size_t(y)] += value(x, y);
    });
    return std::accumulate(rows.begin(), rows.end(), 0.0);
}

}  // namespace

double cells_per_pixel(View<const float> coc_px, const LevelRule& rule, Workers& workers) {
    const double cells = sum_of(coc_px.rect(), workers, [&](int x, int y) {
        return double(std::exp2(-2 * rule.position(coc_px(x, y))));
    });
    return cells / (double(coc_px.width()) * double(coc_px.height()));
}

std::size_t lights_bytes(const EngineView& input, const HighlightSplit& split) {
    constexpr double kPerRadius = 190, kMost = 64 << 20;
    const View<const Rgba> colour = input.samples.colour;
    const double radii_px = sum_of(colour.rect(), *input.services.workers, [&](int x, int y) {
        const Rgba light = colour(x, y);
        if (split.is_dim(luminance(light), light.a)) return 0.0;
        const float coc_px = split.radius_of_light(x, y, input.samples.coc_px(x, y));
        return split.base(x, y, coc_px, light) == light ? 0.0 : double(std::abs(coc_px));
    });
    return std::size_t(std::min(kPerRadius * radii_px, kMost));
}

double samples_per_pixel(const EngineView& input) {
    constexpr double kPerSilhouettePixel = 3.2, kPerHidingPixel = 0.8;
    const double pixels = double(input.width()) * double(input.height());
    const double stated = std::max(1.0, double(input.samples.deep.samples().size()) / pixels);
    if (!input.samples.plate.empty() && input.samples.plate.covers) return stated;
    const Silhouettes silhouettes = silhouettes_of(input.samples.coc_px, *input.services.workers);
    return stated + kPerSilhouettePixel * silhouettes.at + kPerHidingPixel * silhouettes.hiding;
}

double layer_bytes_per_pixel(std::size_t layers, double samples) {
    constexpr double kCopy = 50, kCopyOfSample = 92;
    return layers > 0 ? kCopy + samples * (kCopyOfSample + double(layers * sizeof(Rgba))) : 0;
}

std::size_t bytes_at_once(const EngineView& input, const LevelRule& rule, const HighlightSplit& split,
                          bool has_spare) {
    // Pixels at silhouettes, and pixels that hide a surface, have more samples and sources. Lights come when
    // the samples are gone.
    constexpr double kPerPixel = 39, kPerCell = 82, kPerSilhouettePixel = 305, kPerHidingPixel = 80,
                     kGoneBeforeLights = 16, kFixed = 15 << 20, kProcess = 22 << 20, kAberrated = 28 << 20,
                     kByPlace = 28 << 20;
    const bool flat =
        input.samples.deep.empty() && input.samples.plate.empty() && input.samples.holdout.empty();
    if (!flat) return std::numeric_limits<std::size_t>::max();
    Workers& workers = *input.services.workers;
    const View<const float> coc_px = input.samples.coc_px;
    const Silhouettes silhouettes = silhouettes_of(coc_px, workers);
    const double pixels = double(input.width()) * double(input.height());
    const double per_pixel = kPerPixel + (has_spare ? 0 : sizeof(Rgba)) +
                             kPerCell * cells_per_pixel(coc_px, rule, workers) +
                             kPerSilhouettePixel * silhouettes.at + kPerHidingPixel * silhouettes.hiding;
    const std::size_t layers = input.samples.layers.size();
    const double of_layers = layers == 0 ? 0
                                         : double(2 * layers * sizeof(Rgba)) +
                                               layer_bytes_per_pixel(layers, samples_per_pixel(input));
    const double lights = std::max(0.0, double(lights_bytes(input, split)) - kGoneBeforeLights * pixels);
    // The fit to large pictures leaves 13 MiB for an empty one, where the process takes 22. Two more are for
    // runs that take more than others.
    const double fixed = std::max(kFixed, kProcess - 17 * pixels);
    const kernel::LensModel& lens = input.lens.level(0);
    const double kernels =
        (lens.reach_px(0) > 0.5 ? kAberrated : 0) + (lens.varies_over_field() ? kByPlace : 0);
    return std::size_t((per_pixel + of_layers) * pixels + lights + kernels + fixed) +
           input.services.beside_bytes;
}

}  // namespace petzval::engine
