#include "glare/streaks.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

namespace petzval::glare {
namespace {

constexpr int kSamples = 4;      // a pass
constexpr int kTile = 16;        // pixels that are dark together are passed over together
constexpr double kFallen = 4.6;  // e-foldings at the end: about 1/100
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

// A picture, and which of its tiles hold any light.
struct Lit {
    Picture light;
    Image<std::uint8_t> tiles;

    Lit(int width, int height)
        : light(width, height), tiles((width + kTile - 1) / kTile, (height + kTile - 1) / kTile) {}
    // Any light in the tile at (column, row), moved by so many pixels?
    bool any(int column, int row, int dx, int dy) const {
        const auto tile = [](int px) { return int(std::floor(double(px) / kTile)); };
        for (int j = tile(row * kTile + dy); j <= tile((row + 1) * kTile - 1 + dy); ++j)
            for (int i = tile(column * kTile + dx); i <= tile((column + 1) * kTile - 1 + dx); ++i)
                if (tiles.rect().contains(i, j) && tiles(i, j)) return true;
        return false;
    }
};

Lit reduced(View<const Rgba> light, int factor, Workers& workers) {
    Lit small((light.width() + factor - 1) / factor, (light.height() + factor - 1) / factor);
    parallel_for(small.tiles.height(), workers, [&](int row) {
        for (int y = row * kTile; y < std::min((row + 1) * kTile, small.light.height()); ++y)
            for (int j = factor * y; j < std::min(factor * (y + 1), light.height()); ++j)
                for (int i = 0; i < light.width(); ++i) {
                    const Rgba& c = light(i, j);
                    if (c.r == 0 && c.g == 0 && c.b == 0) continue;
                    small.light(i / factor, y) += 1.0f / float(factor * factor) * c;
                    small.tiles(i / factor / kTile, row) = 1;
                }
    });
    return small;
}

// out(x, y) += weight * in(x + dx, y + dy)
struct Tap {
    int dx, dy;
    Rgba weight;
};

// The picture shifted by `first` and the next three strides along the spike, ever weaker; between pixels.
std::vector<Tap> taps_of(kernel::Point stride, int first, const Rgba weights[kSamples]) {
    std::vector<Tap> taps;
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

// One tile of one tap; nothing beyond the frame.
void add_tap(Picture& out, const Picture& in, int column, int row, const Tap& tap) {
    const int x0 = std::max(column * kTile, -tap.dx),
              x1 = std::min({(column + 1) * kTile, out.width(), out.width() - tap.dx});
    const int y0 = std::max(row * kTile, -tap.dy),
              y1 = std::min({(row + 1) * kTile, out.height(), out.height() - tap.dy});
    for (int y = y0; y < y1; ++y) {
        const Rgba* from = in.row(y + tap.dy) + tap.dx;
        Rgba* to = out.row(y);
        for (int x = x0; x < x1; ++x) to[x] += tap.weight * from[x];
    }
}

Lit spread(const Lit& in, const std::vector<Tap>& taps, Workers& workers) {
    Lit out(in.light.width(), in.light.height());
    parallel_for(out.tiles.height(), workers, [&](int row) {
        for (int column = 0; column < out.tiles.width(); ++column)
            for (const Tap& tap : taps)
                if (in.any(column, row, tap.dx, tap.dy)) {
                    add_tap(out.light, in.light, column, row, tap);
                    out.tiles(column, row) = 1;
                }
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

// From one cell beside the light on: what stays in its own has not moved.
Lit one_streak(const Lit& light, kernel::Point direction, double radius, Workers& workers) {
    Lit streak(0, 0);
    for (double stride = 1; stride == 1 || stride < radius; stride *= kSamples) {
        Rgba weights[kSamples];
        pass_weights(stride, radius, weights);
        const bool first = stride == 1;
        streak = spread(first ? light : streak, taps_of(stride * direction, first, weights), workers);
    }
    return streak;
}

void add_lit(Picture& sum, const Lit& streak, float share, Workers& workers) {
    parallel_for(streak.tiles.height(), workers, [&](int row) {
        for (int column = 0; column < streak.tiles.width(); ++column)
            if (streak.tiles(column, row))
                add_tap(sum, streak.light, column, row, {0, 0, {share, share, share, 0}});
    });
}

void add_enlarged(View<Rgba> out, const Picture& small, int factor, Workers& workers) {
    const View<const Rgba> view = small.view();
    parallel_for(out.height(), workers, [&](int y) {
        const double sy = (y + 0.5) / factor - 0.5;
        const int j = int(std::floor(sy));
        const float t = float(sy - j);
        for (int x = 0; x < out.width(); ++x) {
            const double sx = (x + 0.5) / factor - 0.5;
            const int i = int(std::floor(sx));
            const float s = float(sx - i);
            out(x, y) += (1 - t) * ((1 - s) * view.clamped(i, j) + s * view.clamped(i + 1, j)) +
                         t * ((1 - s) * view.clamped(i, j + 1) + s * view.clamped(i + 1, j + 1));
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
    const auto directions = spike_directions(aperture, pixel_aspect);
    double shares = 0;
    for (const Length& length : kLengths) shares += 1 / length.share;
    for (const int reduction : {1, 2}) {
        const Lit small = reduced(light, reduction, workers);
        Picture sum(small.light.width(), small.light.height());
        for (const Length& length : kLengths) {
            if (length.reduction != reduction) continue;
            const double radius = std::max(1.0, radius_px / reduction * length.share);
            const float share = amount / float(length.share * shares * double(directions.size()));
            for (const kernel::Point& direction : directions)
                add_lit(sum, one_streak(small, direction, radius, workers), share, workers);
        }
        add_enlarged(out, sum, reduction, workers);
    }
}

}  // namespace petzval::glare
