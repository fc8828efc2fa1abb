#include "session/distort.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval {
namespace {

// The radius that lands at `target`: r (1 + amount r^2) = target, by Newton's method from the target itself.
// Barrel distortion leaves the largest radii nowhere to come from; then the farthest that lands.
double undistorted(double target, double amount) {
    const double farthest = amount < 0 ? std::sqrt(-1 / (3 * amount)) : 2 * target;
    double r = std::min(target, farthest);
    for (int i = 0; i < 12; ++i) {
        const double slope = std::max(1e-3, 1 + 3 * amount * r * r);
        r = std::clamp(r - (r * (1 + amount * r * r) - target) / slope, 0.0, farthest);
    }
    return r;
}

// Between pixels by cubic lines (E. Catmull, R. Rom, 1974), kept within the four nearest pixels: what is
// bright throws no dark rings.
Rgba sampled(const Picture& picture, double x, double y) {
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const auto weights = [](double at) {
        const float t = float(at), u = 1 - t;
        return std::array{-0.5f * t * u * u, 1 - 2.5f * t * t + 1.5f * t * t * t,
                          1 - 2.5f * u * u + 1.5f * u * u * u, -0.5f * u * t * t};
    };
    const auto across = weights(x - left), down = weights(y - top);
    Rgba sum, least, most;
    bool first = true;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const Rgba p = picture(std::clamp(left - 1 + i, 0, picture.width() - 1),
                                   std::clamp(top - 1 + j, 0, picture.height() - 1));
            sum += p * (across[std::size_t(i)] * down[std::size_t(j)]);
            if (i == 0 || i == 3 || j == 0 || j == 3) continue;
            least = first ? p
                          : Rgba{std::min(least.r, p.r), std::min(least.g, p.g), std::min(least.b, p.b),
                                 std::min(least.a, p.a)};
            most = first ? p
                         : Rgba{std::max(most.r, p.r), std::max(most.g, p.g), std::max(most.b, p.b),
                                std::max(most.a, p.a)};
            first = false;
        }
    return {std::clamp(sum.r, least.r, most.r), std::clamp(sum.g, least.g, most.g),
            std::clamp(sum.b, least.b, most.b), std::clamp(sum.a, least.a, most.a)};
}

// Where what is seen at (x, y) comes from, in pixels.
struct Origin {
    double x = 0, y = 0;
};
Origin origin_of(int x, int y, const PixelField& field, double amount) {
    const double right = x + 0.5 - field.field_centre_x;
    const double down = (y + 0.5 - field.field_centre_y) / field.pixel_aspect;
    const double target = field.field_per_px * std::hypot(right, down);
    const double scale = target > 0 ? undistorted(target, amount) / target : 1;
    return {field.field_centre_x + scale * right - 0.5,
            field.field_centre_y + scale * down * field.pixel_aspect - 0.5};
}

}  // namespace

Picture distorted(const Picture& picture, const PixelField& field, double amount, Workers& workers) {
    Picture result = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(picture.height(), workers, [&](int y) {
        for (int x = 0; x < picture.width(); ++x) {
            const Origin from = origin_of(x, y, field, amount);
            result(x, y) = sampled(picture, from.x, from.y);
        }
    });
    return result;
}

Rect before_distortion(const Rect& pixels, const PixelField& field, double amount) {
    constexpr int kBetween = 3;  // pixels that sampled() looks at, and one
    const Origin first = origin_of(pixels.x0, pixels.y0, field, amount);
    double left = first.x, right = first.x, top = first.y, bottom = first.y;
    const auto include = [&](int x, int y) {
        const Origin from = origin_of(x, y, field, amount);
        left = std::min(left, from.x), right = std::max(right, from.x);
        top = std::min(top, from.y), bottom = std::max(bottom, from.y);
    };
    // What lies inside of a border stays inside of it.
    for (int x = pixels.x0; x < pixels.x1; ++x) include(x, pixels.y0), include(x, pixels.y1 - 1);
    for (int y = pixels.y0; y < pixels.y1; ++y) include(pixels.x0, y), include(pixels.x1 - 1, y);
    return Rect{int(std::floor(left)), int(std::floor(top)), int(std::ceil(right)) + 1,
                int(std::ceil(bottom)) + 1}
        .grown(kBetween);
}

}  // namespace petzval
