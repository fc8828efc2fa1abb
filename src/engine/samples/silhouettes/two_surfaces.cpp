#include "engine/samples/silhouettes/two_surfaces.h"

#include "engine/samples/completion_model.h"

#include <array>

namespace petzval::engine {
namespace {

constexpr float kTiny = 1e-16f;    // keeps quotients finite
constexpr float kLeastFar = 0.1f;  // a farther surface that covers less of a pixel gains no more light

}  // namespace

float least_variance(Rgba c, ModelErrors errors) {
    const float white = std::min(errors.white, kMostLight);
    const float squared = light2(c) + white * white;
    return kTiny + errors.unmixed2 + errors.times * errors.times * completion_model.model_error2 * squared;
}

Explained expected(Rgba c, const Guess& near, const Guess& far, float by_shape, ModelErrors errors,
                   float far_gains) {
    constexpr std::size_t kShares = 11;
    const float least = least_variance(c, errors);
    std::array<float, kShares> unlikely, variance;  // -2 log of the likelihood, but for the variance
    for (std::size_t i = 0; i < kShares; ++i) {
        const float s = float(i) / (kShares - 1),
                    off = (s - by_shape) / (errors.times * completion_model.shape_error);
        variance[i] = s * s * near.variance + (1 - s) * (1 - s) * far.variance + least;
        unlikely[i] = distance2(c, s * near.colour + (1 - s) * far.colour) / variance[i] + off * off;
    }
    const float best = *std::min_element(unlikely.begin(), unlikely.end());
    float share = 0, total = 0;
    Rgba step;
    for (std::size_t i = 0; i < kShares; ++i) {
        const float s = float(i) / (kShares - 1);
        const float weight = std::exp(-0.5f * (unlikely[i] - best)) / (variance[i] * std::sqrt(variance[i]));
        share += weight * s, total += weight;
        const float varies = (1 - s) * far.variance + far_gains * least / std::max(kLeastFar, 1 - s);
        step += (weight * varies / variance[i]) * (c - s * near.colour - (1 - s) * far.colour);
    }
    return {share / total, light_only(far.colour + (1 / total) * step)};
}

float unmixed2(Rgba c, Rgba near, Rgba far) {
    const Rgba across = near - far;
    const float along = std::clamp(dot(c - far, across) / std::max(kTiny, dot(across, across)), 0.0f, 1.0f);
    return distance2(c, far + along * across);
}

float unexplained(Rgba c, Rgba near, Rgba far) {
    constexpr float kNone = 0.1f, kAll = 0.5f;  // of the squared light
    const float apart = unmixed2(c, near, far) / std::max(kTiny, light2(c));
    return std::clamp((apart - kNone) / (kAll - kNone), 0.0f, 1.0f);
}

float least_share_before(Rgba c, float near_share, Rgba behind) {
    const auto at_most = [&](float own, float from_behind) {
        if ((1 - near_share) * from_behind > own) near_share = 1 - std::max(0.0f, own) / from_behind;
    };
    at_most(c.r, behind.r), at_most(c.g, behind.g), at_most(c.b, behind.b);
    return near_share;
}

float share_before(Rgba c, const Guess& near, Rgba behind, float by_shape, ModelErrors errors) {
    const Guess known{comparable(behind), 0};
    return least_share_before(c, expected(comparable(c), near, known, by_shape, errors).near_share, behind);
}

}  // namespace petzval::engine
