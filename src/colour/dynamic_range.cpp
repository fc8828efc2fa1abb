// Levels of a picture by rank, from a histogram of sixteenths of a stop.
#include "petzval/dynamic_range.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace petzval {
namespace {

constexpr int kPerStop = 16, kLowest_stops = -30, kStops = 60;
constexpr double kLargestHalf = 65504;
constexpr double kOneInHalf = 1.0005;  // 1, and one step of half float above

struct Tally {
    std::array<std::size_t, std::size_t(kPerStop) * std::size_t(kStops)> by_level{};
    std::size_t pixels = 0, lit = 0;
    std::size_t codes = 0, on_grid = 0;  // channel values above 0; those that are n/255
    double brightest = 0;
};

int level_of(double luminance) {
    const double stops = std::log2(luminance) - kLowest_stops;
    return std::clamp(int(stops * kPerStop), 0, kPerStop * kStops - 1);
}

// n/255 for a whole n, as near as half float writes it.
bool is_code(double v) {
    const double code = 255 * v;
    return std::abs(code - std::round(code)) < 0.005 + code / 4096;
}

Tally tally(View<const Rgba> picture) {
    Tally t;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const Rgba c = picture(x, y);
            ++t.pixels;
            for (const float v : {c.r, c.g, c.b}) {
                if (!(v > 0) || !std::isfinite(v)) continue;
                t.brightest = std::max(t.brightest, double(v));
                ++t.codes, t.on_grid += is_code(double(v));
            }
            const double light = double(luminance(c));
            if (!(light > 0) || !std::isfinite(light)) continue;
            ++t.lit, ++t.by_level[std::size_t(level_of(light))];
        }
    return t;
}

// The level that a share of the lit pixels lies below.
double level_at(const Tally& t, double share) {
    std::size_t below = 0;
    for (std::size_t i = 0; i < t.by_level.size(); ++i) {
        below += t.by_level[i];
        if (below > 0 && double(below) >= share * double(t.lit))
            return std::exp2((double(i) + 0.5) / kPerStop + kLowest_stops);
    }
    return 0;
}

double share_at_top(View<const Rgba> picture, double top) {
    std::size_t count = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            const Rgba c = picture(x, y);
            count += double(std::max({c.r, c.g, c.b})) >= top;
        }
    return double(count) / (double(picture.width()) * picture.height());
}

std::string rounded(double value) {
    std::ostringstream text;
    text.precision(2);
    text << value;
    return text.str();
}

// The ratios of M. Kawase (CEDEC 2008; docs/explain/dynamic-range.md): sun to shade 10 to 100, shade to a
// room about 10.
std::string compared(double diffuse_over_shadow) {
    const std::string contrast = " the contrast of sun and shade (10 to 100 times)";
    const std::string times = rounded(diffuse_over_shadow) + " times the shadow: ";
    if (diffuse_over_shadow < 10) return times + "below" + contrast;
    if (diffuse_over_shadow <= 100) return times + "within" + contrast;
    return times + "above" + contrast + ", as in a room with the outdoors in view";
}

DynamicRange nothing_lit(const Tally& t) {
    DynamicRange range;
    range.black_share = 1 - double(t.lit) / double(t.pixels);
    range.brightest = t.brightest;
    return range;
}

// Adds advice in words about the picture's levels.
void add_advice(DynamicRange& range, bool low, bool display_referred) {
    if (range.looks_encoded)
        range.advice.push_back(
            "nothing is brighter than 1 and the middle lies at " + rounded(range.middle) +
            ": this looks like display codes, not light. As light, its range is too small (0.2 on a display "
            "is 0.029 of white), and blurred highlights look dull: convert it to scene-linear light first");
    if (low && range.clipped_share > 1e-4)
        range.advice.push_back(
            rounded(100 * range.clipped_share) +
            " % of the pixels are clipped at 1: lights are no brighter than diffuse white, so their blur "
            "will be dull; plate.expand_highlights estimates their brightness");
    const double stops = range.diffuse_over_shadow_stops;
    if (!display_referred && stops > 0.5 && stops < 2 && range.specular_over_diffuse_stops < 1.5)
        range.advice.emplace_back(
            "all light lies within a few stops; if the picture looks flat, compare the ratios of the scene's "
            "lights with real ones before you change develop.contrast");
}

}  // namespace

DynamicRange measure_dynamic_range(View<const Rgba> picture, bool display_referred) {
    if (picture.empty()) return {};
    const Tally t = tally(picture);
    DynamicRange range = nothing_lit(t);
    if (t.lit == 0) return range;
    // Levels are as wide as the histogram's steps, and none is above the brightest value.
    const auto level = [&](double rank) { return std::min(level_at(t, rank), t.brightest); };
    range.shadow = level(0.05), range.middle = level(0.5);
    range.diffuse = level(0.9), range.specular = level(0.999);
    range.diffuse_over_shadow_stops = std::log2(range.diffuse / range.shadow);
    range.specular_over_diffuse_stops = std::log2(range.specular / range.diffuse);
    range.comparison = compared(range.diffuse / range.shadow);
    const bool low = t.brightest <= kOneInHalf;
    if (low && t.brightest > 0.9995) range.clipped_share = share_at_top(picture, 0.9995);
    if (t.brightest >= kLargestHalf) range.clipped_share = share_at_top(picture, kLargestHalf);
    const bool codes = double(t.on_grid) > 0.9 * double(t.codes);
    const double stops = range.diffuse_over_shadow_stops;
    const bool pale = range.middle > 0.25 && stops > 0.5 && stops < 4;  // a flat card says nothing
    range.looks_encoded = !display_referred && low && (codes || pale);
    add_advice(range, low, display_referred);
    return range;
}

}  // namespace petzval
