#include "glare/streaks.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace petzval::glare {
namespace {

constexpr int kFactor = 4;   // of the reduction
constexpr int kSamples = 4;  // a pass
// Streaks of the full length, a quarter and a sixteenth of it, each with four times the light of the longer
// one: together they fall about as 1/r^2, as diffraction does.
constexpr int kLengths = 3;
constexpr double kFallen = 4.6;                        // e-foldings at the end: about 1/100
constexpr double kWavelength_nm[3] = {610, 550, 465};  // of red, green and blue primaries, about
constexpr double kReddest_nm = 700;                    // as the final star: radius_px is its length there

Picture reduced(View<const Rgba> light, Workers& workers) {
    Picture small((light.width() + kFactor - 1) / kFactor, (light.height() + kFactor - 1) / kFactor);
    parallel_for(small.height(), workers, [&](int y) {
        for (int j = kFactor * y; j < std::min(kFactor * (y + 1), light.height()); ++j)
            for (int i = 0; i < light.width(); ++i)
                small(i / kFactor, y) += 1.0f / (kFactor * kFactor) * light(i, j);
    });
    return small;
}

// Between pixels; nothing beyond the frame.
Rgba sample(const Picture& picture, double x, double y) {
    const int i = int(std::floor(x)), j = int(std::floor(y));
    const float s = float(x - i), t = float(y - j);
    const auto at = [&](int column, int row) {
        return picture.rect().contains(column, row) ? picture(column, row) : Rgba{};
    };
    return (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) +
           t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
}

// One pass: the picture, shifted by 0…3 strides along the spike, ever weaker.
Picture spread(const Picture& in, kernel::Point stride, const Rgba weights[kSamples], Workers& workers) {
    Picture out(in.width(), in.height());
    parallel_for(in.height(), workers, [&](int y) {
        for (int x = 0; x < in.width(); ++x)
            for (int k = 0; k < kSamples; ++k)
                out(x, y) += weights[k] * sample(in, x - k * stride.x, y - k * stride.y);
    });
    return out;
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

Picture one_streak(const Picture& light, kernel::Point direction, double radius, Workers& workers) {
    Picture streak = light.clone();
    for (double stride = 1; stride < radius; stride *= kSamples) {
        Rgba weights[kSamples];
        pass_weights(stride, radius, weights);
        streak = spread(streak, stride * direction, weights, workers);
    }
    return streak;
}

void add_enlarged(View<Rgba> out, const Picture& small, float amount, Workers& workers) {
    const View<const Rgba> view = small.view();
    parallel_for(out.height(), workers, [&](int y) {
        const double sy = (y + 0.5) / kFactor - 0.5;
        const int j = int(std::floor(sy));
        const float t = float(sy - j);
        for (int x = 0; x < out.width(); ++x) {
            const double sx = (x + 0.5) / kFactor - 0.5;
            const int i = int(std::floor(sx));
            const float s = float(sx - i);
            out(x, y) += amount * ((1 - t) * ((1 - s) * view.clamped(i, j) + s * view.clamped(i + 1, j)) +
                                   t * ((1 - s) * view.clamped(i, j + 1) + s * view.clamped(i + 1, j + 1)));
        }
    });
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

void add_streaks(View<Rgba> out, View<const Rgba> light, const ApertureShape& aperture, double radius_px,
                 double pixel_aspect, float amount, Workers& workers) {
    const Picture small = reduced(light, workers);
    const auto directions = spike_directions(aperture, pixel_aspect);
    Picture sum(small.width(), small.height());
    double shares = 0;
    for (int k = 0; k < kLengths; ++k) {
        const double length = std::pow(kSamples, -k), radius = std::max(1.0, radius_px / kFactor * length);
        const float share = float(1 / length);
        for (const kernel::Point& direction : directions) {
            const Picture streak = one_streak(small, direction, radius, workers);
            for (std::size_t i = 0; i < sum.size(); ++i) sum.pixels()[i] += share * streak.pixels()[i];
        }
        shares += 1 / length;
    }
    add_enlarged(out, sum, amount / float(shares * double(directions.size())), workers);
}

}  // namespace petzval::glare
