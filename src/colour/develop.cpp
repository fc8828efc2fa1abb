// Developing turns scene-linear light into code values: exposure, tone curve, sRGB, dither.
#include "base/parallel.h"
#include "colour/develop_plan.h"
#include "colour/dither.h"
#include "colour/tone.h"
#include "image/srgb.h"

#include <algorithm>
#include <cmath>

namespace petzval {

double srgb_encode(double linear) { return std::copysign(srgb_code(std::abs(linear)), linear); }

double srgb_decode(double encoded) {
    const double x = std::abs(encoded);
    const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
    return std::copysign(linear, encoded);
}

double colour::power_of(Transfer transfer) {
    switch (transfer) {
        case Transfer::Gamma22:
            return 2.2;
        case Transfer::Gamma20:
            return 2;
        case Transfer::Linear:
            return 1;
        default:
            return 0;
    }
}

namespace {

double signed_power(double value, double exponent) {
    return exponent == 1 ? value : std::copysign(std::pow(std::abs(value), exponent), value);
}

}  // namespace

double encode(Transfer transfer, double linear) {
    const double power = colour::power_of(transfer);
    return power > 0 ? signed_power(linear, 1 / power) : srgb_encode(linear);
}

double decode(Transfer transfer, double code) {
    const double power = colour::power_of(transfer);
    return power > 0 ? signed_power(code, power) : srgb_decode(code);
}

std::vector<std::uint16_t> develop(View<const Rgba> picture, const DevelopSettings& settings) {
    if (picture.empty()) return {};
    return colour::develop(picture, {settings, picture.rect()},
                           *workers_of(settings.threads, settings.workers));
}

namespace colour {
namespace {

// Display-linear, of light.
Rgba shown(Rgba light, const DevelopSettings& settings) {
    if (settings.contrast != 1) light = with_contrast(light, settings.contrast);
    if (settings.tone == ToneCurve::Filmic) light = tone_map(light);
    if (settings.tone == ToneCurve::Reinhard) light = reinhard(light);
    return light;
}

// 0…1; a NaN fails the comparison and is 0.
float displayable(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

}  // namespace

float DevelopPlan::exposure() const { return float(std::exp2(settings.exposure_stops)); }

std::vector<std::uint16_t> develop(View<const Rgba> picture, const DevelopPlan& plan, Workers& workers) {
    const DevelopSettings& settings = plan.settings;
    const int largest = plan.largest_code();
    const float exposure = plan.exposure();
    const View<const Rgba> part = picture.part(plan.part);
    const std::size_t row_codes = std::size_t(part.width()) * plan.channels();
    std::vector<std::uint16_t> codes(plan.pixels() * plan.channels());
    const auto code = [&](float display_linear, int x, int y, int channel) {
        const double encoded = encode(settings.transfer, displayable(display_linear));
        const double u = settings.dither ? dither_pattern(plan.x0 + x, plan.y0 + y, channel) : 0.5;
        return dithered(encoded * largest, largest, u);
    };
    parallel_for(part.height(), workers, [&](int y) {
        std::uint16_t* out = codes.data() + std::size_t(y) * row_codes;
        for (int x = 0; x < part.width(); ++x) {
            const Rgba c = shown(exposure * part(x, y), settings);
            *out++ = code(c.r, x, y, 0);
            *out++ = code(c.g, x, y, 1);
            *out++ = code(c.b, x, y, 2);
            if (settings.alpha) *out++ = dithered(double(displayable(part(x, y).a)) * largest, largest, 0.5);
        }
    });
    return codes;
}

}  // namespace colour
}  // namespace petzval
