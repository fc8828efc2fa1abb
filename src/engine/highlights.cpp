#include "engine/highlights.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kLeastAlpha = 1e-4f;
constexpr float kDark = 1e-3f;  // keeps reciprocals finite; far below anything that is compared with it
constexpr int kNarrowReach = 1, kWideReach = 3;  // cells on either side: 12 and 28 pixels

// Mean of 1 / (luminance + kDark) over cells of `size` pixels. Its reciprocal, the harmonic mean, follows
// what most of the cell shows and hardly moves for a few bright pixels.
Plane reciprocal_cells(View<const Rgba> picture, int size, int threads) {
    Plane cells((picture.width() + size - 1) / size, (picture.height() + size - 1) / size);
    parallel_for(cells.height(), threads, [&](int cy) {
        for (int cx = 0; cx < cells.width(); ++cx) {
            const Rect r =
                Rect{cx * size, cy * size, (cx + 1) * size, (cy + 1) * size}.intersected(picture.rect());
            float sum = 0;
            for (int y = r.y0; y < r.y1; ++y)
                for (int x = r.x0; x < r.x1; ++x)
                    sum += 1 / (std::max(0.0f, luminance(picture(x, y))) + kDark);
            cells(cx, cy) = sum / float(r.width() * r.height());
        }
    });
    return cells;
}

float box_mean(View<const float> cells, int cx, int cy, int reach) {
    const Rect r = Rect{cx - reach, cy - reach, cx + reach + 1, cy + reach + 1}.intersected(cells.rect());
    float sum = 0;
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x) sum += cells(x, y);
    return sum / float(r.width() * r.height());
}

}  // namespace

HighlightSplit::HighlightSplit(View<const Rgba> picture, const HighlightRule& rule, int threads)
    : rule_(rule) {
    const Plane reciprocal = reciprocal_cells(picture, kCell, threads);
    surroundings_ = Plane(reciprocal.width(), reciprocal.height());
    parallel_for(reciprocal.height(), threads, [&](int y) {
        for (int x = 0; x < reciprocal.width(); ++x) {
            const float narrow = 1 / box_mean(reciprocal, x, y, kNarrowReach);
            const float wide = 1 / box_mean(reciprocal, x, y, kWideReach);
            surroundings_(x, y) = std::max(0.0f, std::min(narrow, 2 * wide) - kDark);
        }
    });
}

Rgba HighlightSplit::base(int x, int y, float coc_px, Rgba light) const {
    const float brightness = luminance(light);
    if (light.a <= kLeastAlpha) return {0, 0, 0, light.a};
    const float radius = std::abs(coc_px);
    const float cheapest = rule_.least_floor * light.a;
    if (brightness <= cheapest || radius < rule_.least_radius_px) return light;
    const float floor = std::max(rule_.least_floor, rule_.floor_at_1px * radius * std::sqrt(radius));
    const float bound = light.a * (floor + rule_.factor * surroundings_(x / kCell, y / kCell));
    if (brightness <= bound) return light;
    const Rgba scaled = light * (bound / brightness);
    return {scaled.r, scaled.g, scaled.b, light.a};
}

std::vector<Highlight> take_highlights(CocSamples& samples, const HighlightSplit& split, int threads) {
    const int width = samples.width, height = samples.height();
    std::vector<std::vector<Highlight>> rows(static_cast<std::size_t>(height));
    parallel_for(height, threads, [&](int y) {
        std::size_t i = std::size_t(y) * std::size_t(width);
        for (int x = 0; x < width; ++x, ++i)
            for (std::size_t k = samples.first[i]; k < samples.first[i + 1]; ++k) {
                CocSample& sample = samples.samples[k];
                const Rgba base = split.base(x, y, sample.coc_px, sample.colour);
                if (base == sample.colour) continue;
                rows[std::size_t(y)].push_back({x, y, sample.coc_px, sample.colour - base});
                sample.colour = base;
            }
    });
    std::vector<Highlight> highlights;
    for (const auto& row : rows) highlights.insert(highlights.end(), row.begin(), row.end());
    return highlights;
}

}  // namespace petzval::engine
