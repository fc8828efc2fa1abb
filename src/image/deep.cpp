// Deep pictures merged, made from flat ones, and seen from the front.
#include "petzval/deep.h"

#include "base/parallel.h"
#include "image/deep_pixel.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace petzval {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A total order, nearest first.
bool comes_before(const DeepSample& p, const DeepSample& q) {
    const auto key = [](const DeepSample& s) {
        return std::tie(s.depth, s.depth_back, s.colour.a, s.colour.r, s.colour.g, s.colour.b);
    };
    return key(p) < key(q);
}

std::span<const DeepSample> samples_at(const PlacedDeep& part, int x, int y) {
    if (!part.data_window.contains(x, y)) return {};
    return part.picture->at(x - part.data_window.x0, y - part.data_window.y0);
}

float share(Rgba colour) { return std::clamp(colour.a, 0.f, 1.f); }

// Samples one over the other.
Rgba seen_from_the_front(std::span<const DeepSample> samples) {
    Rgba sum;
    float free = 1;  // share of the pixel that nothing so far hides
    for (const DeepSample& s : samples) {
        sum += s.colour * free;
        free *= 1 - share(s.colour);
    }
    sum.a = 1 - free;
    return sum;
}

float depth_of_half(std::span<const DeepSample> samples, float alpha) {
    if (samples.empty()) return kInfinity;
    float free = 1;
    for (const DeepSample& s : samples) {
        free *= 1 - share(s.colour);
        if (alpha > 0 && 1 - free >= 0.5f * alpha) return s.depth;
    }
    return samples.front().depth;
}

}  // namespace

DeepPicture merge_deep(const std::vector<PlacedDeep>& parts, const Rect& window) {
    std::vector<std::size_t> first{0};
    std::vector<DeepSample> samples;
    first.reserve(std::size_t(window.width()) * std::size_t(window.height()) + 1);
    std::size_t count = 0;
    for (const PlacedDeep& part : parts) count += part.picture->sample_count();
    samples.reserve(count);
    for (int y = window.y0; y < window.y1; ++y)
        for (int x = window.x0; x < window.x1; ++x) {
            for (const PlacedDeep& part : parts) {
                const auto here = samples_at(part, x, y);
                samples.insert(samples.end(), here.begin(), here.end());
            }
            std::sort(samples.begin() + std::ptrdiff_t(first.back()), samples.end(), comes_before);
            first.push_back(samples.size());
        }
    return {window.width(), window.height(), std::move(first), std::move(samples)};
}

DeepPicture deep_from_flat(View<const Rgba> colour, View<const float> depth_m) {
    std::vector<std::size_t> first{0};
    std::vector<DeepSample> samples;
    first.reserve(std::size_t(colour.width()) * std::size_t(colour.height()) + 1);
    for (int y = 0; y < colour.height(); ++y)
        for (int x = 0; x < colour.width(); ++x) {
            if (colour(x, y) != Rgba{}) samples.push_back({colour(x, y), depth_m(x, y), depth_m(x, y)});
            first.push_back(samples.size());
        }
    return {colour.width(), colour.height(), std::move(first), std::move(samples)};
}

void flatten(const DeepPicture& deep, Picture& colour, Plane& depth, int threads, Workers* workers) {
    colour = Picture::uninitialised(deep.width(), deep.height());
    depth = Plane::uninitialised(deep.width(), deep.height());
    parallel_for(deep.height(), *workers_of(threads, workers), [&](int y) {
        std::vector<DeepSample> apart;
        for (int x = 0; x < deep.width(); ++x) {
            std::span<const DeepSample> samples = deep.at(x, y);
            if (samples.size() <= kCrowdedSamples && has_overlaps(samples)) {
                apart.clear();
                tidy_pixel(samples, {}, apart);
                samples = apart;
            }
            colour(x, y) = seen_from_the_front(samples);
            depth(x, y) = depth_of_half(samples, colour(x, y).a);
        }
    });
}

}  // namespace petzval
