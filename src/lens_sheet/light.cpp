#include "lens_sheet/light.h"

#include "petzval/develop.h"
#include "petzval/files.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr SpectralLine kLines[] = {{435.8343, "g", "w-g"},
                                   {486.1327, "F", "w-F"},
                                   {546.0740, "e", "w-e"},
                                   {587.5618, "d", "w-d"},
                                   {656.2725, "C", "w-C"}};

// Seven bits: nobody sees the eighth, and pages are an eighth smaller without.
std::uint16_t code(float value) {
    return std::uint16_t(std::lround(127 * std::clamp(double(value), 0.0, 1.0)) * 255 / 127);
}

}  // namespace

std::span<const SpectralLine> spectral_lines() { return kLines; }

std::vector<colour::SpectralBand> slices(int count) {
    if (count != 3) return colour::spectral_bands(count);
    // Dominant wavelengths of the primaries against D65.
    return {{611.4, 1, 0, 0, 0.2126}, {549.1, 0, 1, 0, 0.7152}, {464.2, 0, 0, 1, 0.0722}};
}

std::string slice_colour(double r, double g, double b) {
    const double most = std::max({r, g, b, 1e-12});
    std::string text;
    for (const double value : {r, g, b})
        text += (text.empty() ? "rgb(" : ",") +
                std::to_string(std::lround(255 * srgb_encode(std::clamp(value / most, 0.0, 1.0))));
    return text + ")";
}

Rgba exposed(Rgba light) {
    const float most = std::max({light.r, light.g, light.b});
    return most > 0 ? (1 / std::sqrt(1 + most * most)) * light : Rgba{};
}

void Canvas::add(const kernel::PointSpread& disc, int x, int y, double gain, const Rect& cell, Flip flip) {
    const Rect& e = disc.extent;
    for (int v = e.y0; v < e.y1; ++v)
        for (int u = e.x0; u < e.x1; ++u) {
            const int px = x + (flip.left_right ? -u : u), py = y + (flip.up_down ? -v : v);
            if (cell.contains(px, py) && light_.view().rect().contains(px, py))
                light_(px, py) += float(gain) * disc.weights(u - e.x0, v - e.y0);
        }
}

std::string Canvas::uri() const {
    Picture codes(light_.width(), light_.height());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const Rgba shown = exposed(light_.pixels()[i]);
        codes.pixels()[i] = {float(srgb_encode(shown.r)), float(srgb_encode(shown.g)),
                             float(srgb_encode(shown.b)), 1};
    }
    return picture_uri(codes);
}

double even_gain(const kernel::PointSpread& disc, double level) {
    // A flat disc of radius R has the second moment R^2 / 2.
    double moment = 0, sum = 0;
    for (int y = 0; y < disc.weights.height(); ++y)
        for (int x = 0; x < disc.weights.width(); ++x) {
            const double dx = x + disc.extent.x0, dy = y + disc.extent.y0;
            const double light = luminance(disc.weights(x, y));
            moment += light * (dx * dx + dy * dy);
            sum += light;
        }
    return level * std::numbers::pi * std::max(2 * moment / std::max(sum, 1e-12), 0.5);
}

std::string picture_uri(View<const Rgba> codes) {
    PngPixels png{codes.width(), codes.height(), 3, 8, {}};
    for (int y = 0; y < codes.height(); ++y) {
        const Rgba* row = codes.row(y);
        for (int x = 0; x < codes.width(); ++x)
            for (const float value : {row[x].r, row[x].g, row[x].b}) png.samples.push_back(code(value));
    }
    const auto bytes = png_bytes(png);
    PETZVAL_CHECK(bytes.has_value());
    return "data:image/png;base64," + base64(*bytes);
}

std::string base64(const std::string& bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U;
    };
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (int k = 3; k >= 0; --k)
            text += i + std::size_t(3 - k) > bytes.size() ? '=' : kDigits[three >> (6 * k) & 63];
    }
    return text;
}

}  // namespace petzval::lens_sheet
