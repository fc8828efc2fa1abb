#include "colour/tone.h"

#include <algorithm>
#include <cmath>

namespace petzval::colour {
namespace {

constexpr double kMidGrey = 0.18;
constexpr double kContrast = 1 / (1 - kMidGrey);  // p
constexpr double kPalingHalf = 16;                // largest channel at which half the saturation is left
constexpr double kBrightest = 1e9;                // where t is 1 to the last digit; keeps infinity out

// `curve` on the largest channel; the others keep their ratios to it.
template <typename Curve>
Rgba on_largest(Rgba c, Curve curve) {
    const auto positive = [](float x) { return x > 0 ? std::min(double(x), kBrightest) : 0.0; };
    const double r = positive(c.r), g = positive(c.g), b = positive(c.b);
    const double n = std::max({r, g, b});
    if (n == 0) return {0, 0, 0, c.a};
    const double factor = curve(n) / n;
    return {float(factor * r), float(factor * g), float(factor * b), c.a};
}

}  // namespace

double tone_curve(double scene_linear) {
    // t = 1 / (1 + c/n^p) with c/n^p = (1 - g)/g (g/n)^p: one power, and no overflow at either end.
    if (!(scene_linear > 0)) return 0;
    return 1 / (1 + (1 - kMidGrey) / kMidGrey * std::pow(kMidGrey / scene_linear, kContrast));
}

Rgba tone_map(Rgba scene_linear) {
    const auto positive = [](float x) { return x > 0 ? std::min(double(x), kBrightest) : 0.0; };
    const double r = positive(scene_linear.r), g = positive(scene_linear.g), b = positive(scene_linear.b);
    const double n = std::max({r, g, b});
    if (n == 0) return {0, 0, 0, scene_linear.a};
    const double shown = tone_curve(n);
    const double paling = n * n / (n * n + kPalingHalf * kPalingHalf);
    const auto channel = [&](double x) { return float(shown * (x / n * (1 - paling) + paling)); };
    return {channel(r), channel(g), channel(b), scene_linear.a};
}

Rgba reinhard(Rgba scene_linear) {
    const auto shown = [](double n) { return n / (1 + n); };
    return on_largest(scene_linear, shown);
}

Rgba with_contrast(Rgba scene_linear, double contrast) {
    return on_largest(scene_linear, [=](double n) { return kMidGrey * std::pow(n / kMidGrey, contrast); });
}

}  // namespace petzval::colour
