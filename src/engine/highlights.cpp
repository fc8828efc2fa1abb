#include "engine/highlights.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>

namespace petzval::engine {
namespace {

constexpr int kReach = 3;   // medians of 2 * 3 + 1 = 7
constexpr int kCoarse = 4;  // pixels per cell of the wide median: 7 * 4 = 28
constexpr float kLeastAlpha = 1e-4f;

float median(std::array<float, 2 * kReach + 1>& values) {
    std::nth_element(values.begin(), values.begin() + kReach, values.end());
    return values[kReach];
}

// Median of rows, then of columns: not the true 2-D median, but as blind to what is small.
Plane separable_median(View<const float> plane, int threads) {
    Plane rows = Plane::uninitialised(plane.width(), plane.height());
    Plane both = Plane::uninitialised(plane.width(), plane.height());
    const auto pass = [threads](View<const float> from, View<float> to, int dx, int dy) {
        parallel_for(from.height(), threads, [&](int y) {
            std::array<float, 2 * kReach + 1> values;
            for (int x = 0; x < from.width(); ++x) {
                for (int k = -kReach; k <= kReach; ++k)
                    values[std::size_t(k + kReach)] = from.clamped(x + k * dx, y + k * dy);
                to(x, y) = median(values);
            }
        });
    };
    pass(plane, rows, 1, 0);
    pass(rows, both, 0, 1);
    return both;
}

Plane luminance_of(View<const Rgba> colour, int threads) {
    Plane plane = Plane::uninitialised(colour.width(), colour.height());
    parallel_for(colour.height(), threads, [&](int y) {
        for (int x = 0; x < colour.width(); ++x) plane(x, y) = luminance(colour(x, y));
    });
    return plane;
}

Plane reduced(View<const float> plane) {
    Plane small((plane.width() + kCoarse - 1) / kCoarse, (plane.height() + kCoarse - 1) / kCoarse);
    for (int y = 0; y < small.height(); ++y)
        for (int x = 0; x < small.width(); ++x) {
            const Rect cell =
                Rect{x * kCoarse, y * kCoarse, (x + 1) * kCoarse, (y + 1) * kCoarse}.intersected(
                    plane.rect());
            float sum = 0;
            for (int v = cell.y0; v < cell.y1; ++v)
                for (int u = cell.x0; u < cell.x1; ++u) sum += plane(u, v);
            small(x, y) = sum / float(cell.width() * cell.height());
        }
    return small;
}

}  // namespace

HighlightSplit::HighlightSplit(View<const Rgba> picture, float factor, float floor, int threads)
    : bound_(Plane::uninitialised(picture.width(), picture.height())) {
    const Plane light = luminance_of(picture, threads);
    const Plane narrow = separable_median(light, threads);
    const Plane wide = separable_median(reduced(light), threads);
    parallel_for(picture.height(), threads, [&](int y) {
        for (int x = 0; x < picture.width(); ++x)
            bound_(x, y) =
                floor + factor * std::max(0.0f, std::min(narrow(x, y), 2 * wide(x / kCoarse, y / kCoarse)));
    });
}

Rgba HighlightSplit::base(int x, int y, Rgba light) const {
    const float bound = light.a > kLeastAlpha ? bound_(x, y) * light.a : 0;
    const float brightness = luminance(light);
    if (brightness <= bound) return light;
    const Rgba scaled = light * (bound / brightness);
    return {scaled.r, scaled.g, scaled.b, light.a};
}

SplitInput split_highlights(const Input& input, const HighlightSplit& split) {
    const int width = input.width(), height = input.height();
    SplitInput result{Picture::uninitialised(width, height), input.deep, {}};
    std::vector<std::vector<Highlight>> rows(static_cast<std::size_t>(height));
    parallel_for(height, input.threads, [&](int y) {
        const auto take = [&](int x, float coc_px, Rgba& light) {
            const Rgba base = split.base(x, y, light);
            if (!(base == light)) rows[std::size_t(y)].push_back({x, y, coc_px, light - base});
            light = base;
        };
        for (int x = 0; x < width; ++x) {
            Rgba& visible = result.base(x, y) = input.colour(x, y);
            if (input.deep.empty()) {
                take(x, input.coc_px(x, y), visible);
                continue;
            }
            visible = split.base(x, y, visible);
            const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
            for (std::size_t k = result.deep.first[i]; k < result.deep.first[i + 1]; ++k)
                take(x, result.deep.samples[k].coc_px, result.deep.samples[k].colour);
        }
    });
    for (const auto& row : rows) result.highlights.insert(result.highlights.end(), row.begin(), row.end());
    return result;
}

}  // namespace petzval::engine
