#include "glare/streaks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace petzval::glare {
namespace {

constexpr int kSamples = 4;                            // a pass
constexpr double kFallen = 4.6;                        // e-foldings at the end: about 1/100
constexpr double kWavelength_nm[3] = {610, 550, 465};  // of red, green and blue primaries, about
constexpr double kReddest_nm = 700;                    // as the final star: radius_px is its length there

// Streaks of the full length, a quarter and a sixteenth of it, each with four times the light of the longer
// one: together they fall about as 1/r^2, as diffraction does. The shortest holds most light and is what the
// eye takes for the star: it is drawn pixel by pixel, or lamps become the squares of a reduced picture.
struct Length {
    double share;   // of the radius; its light is as 1 / share
    int reduction;  // pixels to a cell
};
constexpr Length kLengths[] = {{1, 2}, {1.0 / 4, 2}, {1.0 / 16, 1}};

// The picture shifted by `first` and the next three strides along the spike, ever weaker; between pixels.
std::vector<StarTap> taps_of(kernel::Point stride, int first, const Rgba weights[kSamples]) {
    std::vector<StarTap> taps;
    for (int k = 0; k < kSamples; ++k) {
        const double x = -(k + first) * stride.x, y = -(k + first) * stride.y;
        const int i = int(std::floor(x)), j = int(std::floor(y));
        const float s = float(x - i), t = float(y - j);
        for (const auto& [dx, dy, w] :
             {std::tuple{0, 0, (1 - s) * (1 - t)}, {1, 0, s * (1 - t)}, {0, 1, (1 - s) * t}, {1, 1, s * t}})
            if (w > 0) taps.push_back({i + dx, j + dy, w * weights[k]});
    }
    return taps;
}

void pass_weights(double stride, double radius, Rgba weights[kSamples]) {
    float Rgba::*const channels[3] = {&Rgba::r, &Rgba::g, &Rgba::b};
    for (int c = 0; c < 3; ++c) {
        const double per_px = kFallen / radius * kReddest_nm / kWavelength_nm[c];
        double sum = 0;
        for (int k = 0; k < kSamples; ++k) sum += std::exp(-per_px * stride * k);
        for (int k = 0; k < kSamples; ++k)
            weights[k].*channels[c] = float(std::exp(-per_px * stride * k) / sum);
    }
}

// Passes from one cell beside the light on: light in its own cell has not moved.
std::vector<std::vector<StarTap>> passes_of(kernel::Point direction, double radius) {
    std::vector<std::vector<StarTap>> passes;
    for (double stride = 1; stride == 1 || stride < radius; stride *= kSamples) {
        Rgba weights[kSamples];
        pass_weights(stride, radius, weights);
        passes.push_back(taps_of(stride * direction, stride == 1, weights));
    }
    return passes;
}

}  // namespace

std::vector<kernel::Point> spike_directions(const ApertureShape& aperture, double pixel_aspect) {
    const int count = aperture.blades % 2 == 0 ? aperture.blades : 2 * aperture.blades;
    const double wide = std::min(1.0, 1 / aperture.squeeze), tall = std::min(1.0, aperture.squeeze);
    const double first = aperture.rotation_deg + 180.0 / aperture.blades;
    std::vector<kernel::Point> directions;
    for (int k = 0; k < count; ++k) {
        const double angle = (first + 360.0 * k / count) * std::numbers::pi / 180;
        // A normal of a squeezed shape; y turns from up to down.
        const double x = std::cos(angle) / wide, y = -std::sin(angle) / tall * pixel_aspect;
        directions.push_back((1 / std::hypot(x, y)) * kernel::Point{x, y});
    }
    return directions;
}

std::vector<Streak> plan_streaks(const ApertureShape& aperture, double radius_px, double pixel_aspect) {
    const auto directions = spike_directions(aperture, pixel_aspect);
    double shares = 0;
    for (const Length& length : kLengths) shares += 1 / length.share;
    std::vector<Streak> streaks;
    for (const int reduction : {1, 2})
        for (const Length& length : kLengths) {
            if (length.reduction != reduction) continue;
            const double radius = std::max(1.0, radius_px / reduction * length.share);
            const float parts = float(length.share * shares * double(directions.size()));
            for (const kernel::Point& direction : directions)
                streaks.push_back({reduction, parts, passes_of(direction, radius)});
        }
    return streaks;
}

}  // namespace petzval::glare
