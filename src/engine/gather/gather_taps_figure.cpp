#include "engine/gather/gather_taps_figure.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr Rgba kNear{0.024f, 0.275f, 0.745f, 1}, kFar{0.896f, 0.332f, 0.006f, 1}, kRim{0.5f, 0.5f, 0.5f, 1};
constexpr float kDimmed = 0.25f, kIdle = 0.35f;
constexpr int kRows = 2;  // discs one above the other

// Fraction of a pixel inside an edge at this distance; the distance is negative inside.
float inside(float distance) { return std::clamp(0.5f - distance, 0.0f, 1.0f); }

// Distance of (px, py) from the line between a and b.
float to_line(float px, float py, float ax, float ay, float bx, float by) {
    const float dx = bx - ax, dy = by - ay, squared = dx * dx + dy * dy;
    const float t = squared > 0 ? std::clamp(((px - ax) * dx + (py - ay) * dy) / squared, 0.0f, 1.0f) : 0;
    return std::hypot(px - ax - t * dx, py - ay - t * dy);
}

struct Disc {
    int x, y;      // the pixel in its middle
    float radius;  // as drawn
};

// Colour at (x, y) from the middle of the disc, drawn over `under`.
Rgba drawn_at(float x, float y, float radius, Rgba under, const std::vector<DrawnTap>& taps) {
    const float dot = std::max(1.2f, radius / 30), line = std::max(0.5f, radius / 120);
    Rgba seen = under;
    const auto over = [&](Rgba colour, float share) {
        seen = seen + share * (colour - seen);
        seen.a = 1;
    };
    for (const bool counts : {false, true})
        for (const DrawnTap& tap : taps) {
            if (tap.counts != counts) continue;
            const Rgba colour = (counts ? 1.0f : kIdle) * (tap.is_behind ? kFar : kNear);
            const float distance = std::hypot(tap.x, tap.y), tx = radius * tap.x, ty = radius * tap.y;
            const float left = distance > 0 ? std::max(0.0f, 1 - tap.reach / distance) : 0;
            over(colour, inside(to_line(x, y, tx, ty, left * tx, left * ty) - line));
            over(colour, inside(std::hypot(x - tx, y - ty) - dot));
        }
    over({1, 1, 1, 1}, inside(std::abs(std::hypot(x, y) - 1.6f * dot) - 0.5f));
    over(kRim, inside(std::abs(std::hypot(x, y) - 1.1f * radius) - 0.5f));
    return seen;
}

void draw_disc(TapsFigure& figure, const Disc& disc, Workers& workers) {
    const std::vector<DrawnTap> taps = figure.taps(disc.x, disc.y);
    const int reach = int(1.1f * disc.radius) + 1;
    Picture& picture = figure.picture;
    const int top = std::max(0, disc.y - reach), bottom = std::min(picture.height(), disc.y + reach + 1);
    parallel_for(bottom - top, workers, [&](int row) {
        const int y = top + row;
        for (int x = std::max(0, disc.x - reach); x < std::min(picture.width(), disc.x + reach + 1); ++x) {
            const float u = float(x - disc.x) / disc.radius, v = float(y - disc.y) / disc.radius;
            if (std::hypot(u, v) > 1.1f + 1 / disc.radius) continue;
            const Rgba under =
                std::hypot(u, v) < 1.1f ? kDimmed * figure.light(disc.x, disc.y, u, v) : picture(x, y);
            picture(x, y) = drawn_at(u * disc.radius, v * disc.radius, disc.radius, under, taps);
        }
    });
}

}  // namespace

Picture drawn(TapsFigure figure, Workers& workers) {
    const int width = figure.picture.width(), height = figure.picture.height();
    for (std::size_t i = 0; i < figure.picture.size(); ++i) {
        Rgba& c = figure.picture.pixels()[i];
        c = {kDimmed * c.r, kDimmed * c.g, kDimmed * c.b, 1};
    }
    const int cell = std::max(1, height / kRows), across = std::max(1, width / cell);
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < across; ++i) {
            const Disc disc{(2 * i + 1) * width / (2 * across), (2 * j + 1) * height / (2 * kRows),
                            0.42f * float(std::min(cell, width / across))};
            if (disc.radius >= 2) draw_disc(figure, disc, workers);
        }
    return std::move(figure.picture);
}

}  // namespace petzval::engine
