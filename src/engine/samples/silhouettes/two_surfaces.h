// Estimates the coverage of two surfaces in one pixel, from their colours and from the silhouette's shape.
#pragma once

#include "petzval/image.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

// Light for comparisons, limited so that its squares stay finite.
constexpr float kMostLight = 1e8f;
inline Rgba comparable(Rgba c) {
    constexpr float kMost = kMostLight;
    return {std::clamp(c.r, -kMost, kMost), std::clamp(c.g, -kMost, kMost), std::clamp(c.b, -kMost, kMost),
            c.a};
}

inline float distance2(Rgba a, Rgba b) {
    const Rgba d = a - b;
    return d.r * d.r + d.g * d.g + d.b * d.b + d.a * d.a;
}
inline float light2(Rgba c) { return c.r * c.r + c.g * c.g + c.b * c.b; }  // squared, without alpha
inline float dot(Rgba a, Rgba b) { return a.r * b.r + a.g * b.g + a.b * b.b + a.a * b.a; }

// A colour and its variance, the mean of the channels' variances.
struct Guess {
    Rgba colour;
    float variance = 0;
};

// Weighted mean and variance of colours.
class Pool {
public:
    void add(Rgba light, float weight) {
        const Rgba c = comparable(light);
        sum_ += weight * c, squares_ += weight * light2(c), weight_ += weight;
    }
    bool empty() const { return weight_ <= 0; }
    Guess guess() const {
        const Rgba m = sum_ * (1 / weight_);
        const float spread = squares_ / weight_ - light2(m);
        return {m, std::max(0.0f, spread) / 3};
    }

private:
    Rgba sum_;
    float squares_ = 0, weight_ = 0;
};

inline Rgba light_only(Rgba c) {
    return {std::max(0.0f, c.r), std::max(0.0f, c.g), std::max(0.0f, c.b), std::clamp(c.a, 0.0f, 1.0f)};
}

// Explanation of a pixel's colour by two surfaces.
struct Explained {
    float near_share = 0;
    Rgba far_colour;
};

// Errors of the model that two colours and the silhouette's shape explain a pixel, as multiples of those at a
// plain edge. In dark pixels they are relative to white, so that they do not depend on the exposure.
struct ModelErrors {
    float times = 1;
    float white = 0;     // scene-linear luminance
    float unmixed2 = 0;  // squared light that no mixture of the two gives, see unmixed2()
};

// Variance of a colour that counts as exact.
float least_variance(Rgba c, ModelErrors errors);

// The mean of all coverages that explain the pixel's colour c, weighted by their likelihood for c and their
// agreement with the shape. The unexplained rest belongs to the less certain surface. far_gains: the farther
// surface's share of light that neither variance explains; 0: the nearer one gets it.
Explained expected(Rgba c, const Guess& near, const Guess& far, float by_shape, ModelErrors errors,
                   float far_gains = 0);

// Squared distance of colour c from all mixtures of the two.
float unmixed2(Rgba c, Rgba near, Rgba far);

// 0…1: the share of colour c that no mixture of the two explains.
float unexplained(Rgba c, Rgba near, Rgba far);

// The nearer surface's coverage of a pixel of colour c in front of a known background, which contributes no
// more light than the pixel has.
float share_before(Rgba c, const Guess& near, Rgba behind, float by_shape, ModelErrors errors);

// `near_share`, or more if the pixel of colour c is too dark for the rest of this background.
float least_share_before(Rgba c, float near_share, Rgba behind);

}  // namespace petzval::engine
