#include "engine/reference/bright_points.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace petzval::engine {
namespace {

constexpr float kDark = 1e-3f;  // keeps reciprocals finite; far below anything that is compared with it
constexpr float kWidestPx = 1024;
constexpr float kNoRayBetweenPx = 0.02f;  // of radius
constexpr float kOverSurroundings = 1.5f, kOverWhite = 0.25f;
constexpr float kLampOverSurroundings = 8, kLampOverWhite = 2;  // light that ends at the frame's border

// The mean over the square of `reach` pixels to every side of each pixel, as much of it as lies in the
// picture.
Plane square_means(View<const float> values, int reach, Workers& workers) {
    const int width = values.width(), height = values.height();
    Plane across(width, height), means(width, height);
    parallel_for(height, workers, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const int begin = std::max(0, x - reach), end = std::min(width, x + reach + 1);
            for (int u = begin; u < end; ++u) across(x, y) += values(u, y) / float(end - begin);
        }
    });
    parallel_for(height, workers, [&](int y) {
        const int begin = std::max(0, y - reach), end = std::min(height, y + reach + 1);
        for (int v = begin; v < end; ++v)
            for (int x = 0; x < width; ++x) means(x, y) += across(x, v) / float(end - begin);
    });
    return means;
}

float light_of(Rgba c) { return std::max(0.0f, luminance(c)); }

// Harmonic means follow what most of a square shows and hardly move for a few bright pixels.
Plane surroundings_of(View<const Rgba> picture, Workers& workers) {
    Plane reciprocal(picture.width(), picture.height());
    parallel_for(picture.height(), workers, [&](int y) {
        for (int x = 0; x < picture.width(); ++x) reciprocal(x, y) = 1 / (light_of(picture(x, y)) + kDark);
    });
    Plane surroundings = square_means(reciprocal, 6, workers);
    const Plane wide = square_means(reciprocal, 14, workers);
    for (std::size_t i = 0; i < surroundings.size(); ++i) {
        const float mean = std::min(1 / surroundings.pixels()[i], 2 / wide.pixels()[i]);
        surroundings.pixels()[i] = std::max(0.0f, mean - kDark);
    }
    return surroundings;
}

float white_of(View<const Rgba> picture) {
    double sum = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) sum += double(light_of(picture(x, y)));
    return float(4 * sum / (double(picture.width()) * picture.height()));
}

// The fraction of a sample's luminance that stays in the surface. At the frame's border all but a lamp's
// does: a surface continues beyond the border, points do not.
float share_that_stays(const CocSample& s, float surroundings, float white, bool is_at_border) {
    if (s.colour.a <= kLeastCoverage) return 0;
    const float light = luminance(s.colour);
    const float over = is_at_border ? kLampOverSurroundings * surroundings + kLampOverWhite * white
                                    : kOverSurroundings * surroundings + kOverWhite * white;
    const float bound = s.colour.a * over;
    if (std::abs(s.coc_px) > kWidestPx || light - bound <= kOverWhite * white) return 1;
    return bound / light;
}

// True if samples right in front of the last one cover it. No ray is followed between these; facets hide what
// stays on the surface. samples: of one pixel, nearest first.
bool is_covered(std::span<const CocSample> samples) {
    float open = 1;
    for (const CocSample& s : samples.first(samples.size() - 1))
        if (samples.back().coc_px - s.coc_px <= kNoRayBetweenPx) open -= s.colour.a;
    return open < kDark;
}

}  // namespace

std::vector<BrightPoint> take_bright_points(CocSamples& samples, const EngineView& input) {
    const Plane surroundings = surroundings_of(input.samples.colour, *input.services.workers);
    const float white = white_of(input.all().samples.colour);
    const bool dims_itself = input.samples.deep_dims_itself;
    const std::span<const CocSample> all(samples.samples);
    std::vector<BrightPoint> points;
    for (int y = 0; y < samples.height(); ++y)
        for (int x = 0; x < samples.width; ++x) {
            const bool is_at_border = x == 0 || y == 0 || x == samples.width - 1 || y == samples.height() - 1;
            const std::size_t pixel = std::size_t(y) * std::size_t(samples.width) + std::size_t(x);
            const std::size_t first = samples.first[pixel];
            int facets = 0;
            for (std::size_t k = first; k < samples.first[pixel + 1]; ++k) {
                CocSample& s = samples.samples[k];
                const float share = share_that_stays(s, surroundings(x, y), white, is_at_border);
                const int in_front = s.colour.a > kLeastCoverage ? facets++ : facets;
                if (share >= 1) continue;
                if (!dims_itself && is_covered(all.subspan(first, k + 1 - first))) continue;
                const Rgba stays{s.colour.r * share, s.colour.g * share, s.colour.b * share, s.colour.a};
                points.push_back(
                    {x, y, std::clamp(s.coc_px, -kWidestPx, kWidestPx), s.colour - stays, in_front});
                s.colour = stays;
            }
        }
    return points;
}

}  // namespace petzval::engine
