#include "session/rendered/on_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace petzval {
namespace {

// 0…grid-1: how far `at` lies beyond a multiple of the grid.
int beyond(int at, int grid) { return ((at % grid) + grid) % grid; }

// The share of pixel (x, y)'s light that does not stand out of the border around it: twice the harmonic mean
// of luminance in the 13 x 13 pixels around, which few bright ones hardly raise.
float steady_share(View<const Rgba> colour, int x, int y) {
    constexpr int kReach = 6;
    constexpr float kDark = 1e-3f, kOver = 2;
    const auto light = [](Rgba c) {
        return std::isfinite(luminance(c)) ? std::max(0.0f, luminance(c)) : 0.0f;
    };
    const Rect around =
        Rect{x - kReach, y - kReach, x + kReach + 1, y + kReach + 1}.intersected(colour.rect());
    float sum = 0;
    for (int v = around.y0; v < around.y1; ++v)
        for (int u = around.x0; u < around.x1; ++u) sum += 1 / (light(colour(u, v)) + kDark);
    const float most = kOver * float(around.width() * around.height()) / sum;
    return std::min(1.0f, most / (light(colour(x, y)) + kDark));
}

Rgba dimmed(Rgba c, float share) { return {c.r * share, c.g * share, c.b * share, c.a}; }

}  // namespace

Rect on_grid(const Rect& display_window, const Rect& data_window, int grid) {
    Rect window = data_window;
    window.x0 -= beyond(data_window.x0 - display_window.x0, grid);
    window.y0 -= beyond(data_window.y0 - display_window.y0, grid);
    return window;
}

int grid_for(float largest_radius_px, bool spreads_wider) {
    constexpr int kLeast = 64, kMost = 1024;  // of tiles; a coarser grid no longer shows
    const float coarsest = std::min(largest_radius_px, float(kMost)) * (spreads_wider ? 8 : 1);
    return std::clamp(int(std::bit_ceil(unsigned(std::ceil(std::max(1.0f, coarsest))))), kLeast, kMost);
}

WiderFrame::WiderFrame(const Rendered& asked, const Rect& window) : wider_(asked) {
    const Rect& data = asked.place.data_window;
    inside_ = data.moved(-window.x0, -window.y0);
    wider_.place.data_window = window;
    widen_colour(asked);
    wider_.colour = colour_;
    for (ColourLayer& layer : wider_.layers) {
        layers_.push_back(widened(layer.colour));
        layer.colour = layers_.back();
    }
    set_depth(wider_, depth_);
    const auto widen = [&](const DeepPicture*& deep, DeepPicture& own, bool is_matte) {
        if (!deep || deep->empty()) return;
        own = widened(*deep, is_matte);
        deep = &own;
    };
    widen(wider_.deep, deep_, false);
    widen(wider_.behind, behind_, false);
    widen(wider_.holdout, holdout_, true);
    if (!asked.lights) return;
    lights_ = *asked.lights;
    for (LightPoint& p : lights_) {
        p.x += float(inside_.x0);
        p.y += float(inside_.y0);
    }
    wider_.lights = &lights_;
}

void WiderFrame::widen_colour(const Rendered& asked) {
    const Rect &display = asked.place.display_window, &data = asked.place.data_window;
    const int width = wider_.place.data_window.width(), height = wider_.place.data_window.height();
    const View<const float> depth = depth_or_radii(asked);
    depth_ = Plane(width, height);
    kept_ = Plane(width, height, 1.0f);
    const auto is_empty = [&](int x, int y) {
        return (x < inside_.x0 && data.x0 > display.x0) || (x >= inside_.x1 && data.x1 < display.x1) ||
               (y < inside_.y0 && data.y0 > display.y0) || (y >= inside_.y1 && data.y1 < display.y1);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int u = column(x), v = row(y);
            depth_(x, y) = depth(u, v);
            if (!inside_.contains(x, y)) kept_(x, y) = is_empty(x, y) ? 0 : steady_share(asked.colour, u, v);
        }
    colour_ = widened(asked.colour);
}

Picture WiderFrame::widened(View<const Rgba> picture) const {
    Picture wider(kept_.width(), kept_.height());
    for (int y = 0; y < wider.height(); ++y)
        for (int x = 0; x < wider.width(); ++x)
            if (kept_(x, y) > 0) wider(x, y) = dimmed(picture(column(x), row(y)), kept_(x, y));
    return wider;
}

DeepPicture WiderFrame::widened(const DeepPicture& deep, bool is_matte) const {
    std::vector<std::size_t> first{0};
    std::vector<DeepSample> samples;
    first.reserve(colour_.size() + 1);
    samples.reserve(deep.sample_count());
    for (int y = 0; y < colour_.height(); ++y)
        for (int x = 0; x < colour_.width(); ++x) {
            if (kept_(x, y) > 0)
                for (DeepSample s : deep.at(column(x), row(y))) {
                    if (!is_matte) s.colour = dimmed(s.colour, kept_(x, y));
                    samples.push_back(s);
                }
            first.push_back(samples.size());
        }
    return {colour_.width(), colour_.height(), std::move(first), std::move(samples)};
}

}  // namespace petzval
