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

// What of `colour` stays in the base when luminance above `bound` is taken out; alpha always stays.
Rgba kept(Rgba colour, float bound) {
    if (colour.a <= kLeastAlpha) bound = 0;
    const float light = luminance(colour);
    if (light <= bound) return colour;
    const Rgba scaled = colour * (bound / light);
    return {scaled.r, scaled.g, scaled.b, colour.a};
}

}  // namespace

SplitPicture split_highlights(const Input& input, float factor, float floor) {
    const int width = input.width(), height = input.height();
    const Plane light = luminance_of(input.colour, input.threads);
    const Plane narrow = separable_median(light, input.threads);
    const Plane wide = separable_median(reduced(light), input.threads);

    SplitPicture split{Picture::uninitialised(width, height), input.deep, {}};
    std::vector<std::vector<Highlight>> rows(static_cast<std::size_t>(height));
    parallel_for(height, input.threads, [&](int y) {
        const auto take = [&](int x, float coc_px, Rgba& colour, float bound, bool listed) {
            const Rgba rest = kept(colour, bound);
            if (listed && !(rest == colour)) rows[std::size_t(y)].push_back({x, y, coc_px, colour - rest});
            colour = rest;
        };
        for (int x = 0; x < width; ++x) {
            const float surroundings =
                std::max(0.0f, std::min(narrow(x, y), 2 * wide(x / kCoarse, y / kCoarse)));
            const float bound = factor * surroundings + floor;
            split.base(x, y) = input.colour(x, y);
            take(x, input.coc_px(x, y), split.base(x, y), bound, input.deep.empty());
            if (input.deep.empty()) continue;
            const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
            for (std::size_t k = split.deep.first[i]; k < split.deep.first[i + 1]; ++k) {
                CocSample& sample = split.deep.samples[k];
                take(x, sample.coc_px, sample.colour, bound * std::max(sample.colour.a, kLeastAlpha), true);
            }
        }
    });
    for (const auto& row : rows) split.highlights.insert(split.highlights.end(), row.begin(), row.end());
    return split;
}

}  // namespace petzval::engine
