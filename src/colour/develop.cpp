// From scene-linear light to code values: exposure, tone curve, sRGB, dither.
#include "petzval/develop.h"

#include "base/parallel.h"
#include "colour/dither.h"
#include "colour/tone.h"
#include "image/srgb.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace petzval {

double srgb_encode(double linear) { return std::copysign(srgb_code(std::abs(linear)), linear); }

double srgb_decode(double encoded) {
    const double x = std::abs(encoded);
    const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    return std::copysign(linear, encoded);
}

namespace {

// The exponent of a curve that is a power of the code, and nothing for one that is not.
std::optional<double> power_of(Transfer transfer) {
    switch (transfer) {
        case Transfer::Gamma22:
            return 2.2;
        case Transfer::Gamma20:
            return 2;
        case Transfer::Linear:
            return 1;
        default:
            return std::nullopt;
    }
}

double signed_power(double value, double exponent) {
    return exponent == 1 ? value : std::copysign(std::pow(std::abs(value), exponent), value);
}

}  // namespace

double encode(Transfer transfer, double linear) {
    const auto power = power_of(transfer);
    return power ? signed_power(linear, 1 / *power) : srgb_encode(linear);
}

double decode(Transfer transfer, double code) {
    const auto power = power_of(transfer);
    return power ? signed_power(code, *power) : srgb_decode(code);
}

std::vector<std::uint16_t> develop(View<const Rgba> picture, const DevelopSettings& settings) {
    if (picture.empty()) return {};
    const int largest = (1 << settings.bits) - 1;
    const float exposure = float(std::exp2(settings.exposure_stops));
    std::vector<std::uint16_t> codes(std::size_t(picture.width()) * std::size_t(picture.height()) * 3);
    const auto code = [&](float display_linear, int x, int y, int channel) {
        // A NaN fails the comparison and is black.
        const double encoded =
            display_linear > 0 ? encode(settings.transfer, std::min(display_linear, 1.0f)) : 0;
        const double u = settings.dither ? colour::dither_pattern(x, y, channel) : 0.5;
        return colour::dithered(encoded * largest, largest, u);
    };
    parallel_for(picture.height(), *workers_of(settings.threads, settings.workers), [&](int y) {
        std::uint16_t* out = codes.data() + std::size_t(y) * std::size_t(picture.width()) * 3;
        for (int x = 0; x < picture.width(); ++x) {
            Rgba c = exposure * picture(x, y);
            if (settings.contrast != 1) c = colour::with_contrast(c, settings.contrast);
            if (settings.tone == ToneCurve::Filmic) c = colour::tone_map(c);
            if (settings.tone == ToneCurve::Reinhard) c = colour::reinhard(c);
            *out++ = code(c.r, x, y, 0);
            *out++ = code(c.g, x, y, 1);
            *out++ = code(c.b, x, y, 2);
        }
    });
    return codes;
}

}  // namespace petzval
