#include "petzval/views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace petzval {
namespace {

constexpr Rgba kInFocus{1, 1, 1, 1};

std::string digits(float value, int most) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.*g", most, double(value));
    return text.data();
}

struct Largest {
    float near_px = 0, far_px = 0;  // both positive
    float either() const { return std::max({near_px, far_px, 1e-6f}); }
};

Largest largest_radii(View<const float> coc) {
    Largest largest;
    for (int y = 0; y < coc.height(); ++y)
        for (int x = 0; x < coc.width(); ++x) {
            largest.near_px = std::max(largest.near_px, -coc(x, y));
            largest.far_px = std::max(largest.far_px, coc(x, y));
        }
    return largest;
}

struct Entry {
    Rgba colour;
    std::string text;
};

std::vector<Entry> legend_of(const Largest& largest, const std::string& in_focus) {
    const auto up_to = [](const char* name, float radius) {
        return std::string(name) + (radius > 0 ? "RADIUS UP TO " + digits(radius, 3) + " PX" : "NONE");
    };
    return {{kNearColour, up_to("NEAR      ", largest.near_px)},
            {kInFocus, in_focus},
            {kFarColour, up_to("FAR       ", largest.far_px)}};
}

// A dark box at the bottom left: title, then a swatch and a text for each entry.
void draw_legend(View<Rgba> picture, const std::string& title, const std::vector<Entry>& entries) {
    const int scale = std::max(1, (picture.width() + 320) / 640);
    const int line = text_height_px(scale) + 4 * scale, margin = 6 * scale, swatch = text_height_px(scale);
    int width = text_width_px(title, scale);
    for (const Entry& entry : entries) width = std::max(width, 2 * swatch + text_width_px(entry.text, scale));
    const int height = int(entries.size() + 1) * line;
    const Rect box{margin, picture.height() - height - 3 * margin, width + 3 * margin,
                   picture.height() - margin};
    if (box.x1 > picture.width() || box.y0 < 0) return;
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) picture(x, y) = {0.01f, 0.01f, 0.01f, 1};
    int y = box.y0 + margin;
    const int x = box.x0 + margin;
    draw_text(picture, x, y, title, scale, {0.6f, 0.6f, 0.6f, 1});
    for (const Entry& entry : entries) {
        y += line;
        for (int sy = 0; sy < swatch; ++sy)
            for (int sx = 0; sx < swatch; ++sx) picture(x + sx, y + sy) = entry.colour;
        draw_text(picture, x + 2 * swatch, y, entry.text, scale, kInFocus);
    }
}

}  // namespace

Picture focus_overlay(View<const Rgba> display, View<const float> coc, float permissible_radius_px,
                      const std::string& title) {
    const Largest largest = largest_radii(coc);
    Picture view(coc.width(), coc.height());
    for (int y = 0; y < coc.height(); ++y)
        for (int x = 0; x < coc.width(); ++x) {
            const float radius = coc(x, y), light = luminance(display(x, y));
            if (std::isnan(radius)) {
                view(x, y) = {0, 0, 0, 1};
                continue;
            }
            const bool sharp = std::abs(radius) < permissible_radius_px;
            const Rgba tint = sharp ? kInFocus : radius < 0 ? kNearColour : kFarColour;
            // Deeper blur is tinted more strongly, each side by its own measure; all of it stays readable.
            const float deepest =
                std::max(radius < 0 ? largest.near_px : largest.far_px, permissible_radius_px);
            const float strength = sharp ? 0.6f : 0.35f + 0.45f * std::sqrt(std::abs(radius) / deepest);
            const Rgba grey = 0.5f * light * Rgba{1, 1, 1, 1};
            view(x, y) = grey * (1 - strength) + tint * (strength * (0.3f + 0.7f * light));
            view(x, y).a = 1;
        }
    draw_legend(view.view(), title,
                legend_of(largest, "IN FOCUS  RADIUS UNDER " + digits(permissible_radius_px, 6) + " PX"));
    return view;
}

Picture coc_map(View<const float> coc, const std::string& title) {
    const Largest largest = largest_radii(coc);
    Picture view(coc.width(), coc.height());
    for (int y = 0; y < coc.height(); ++y)
        for (int x = 0; x < coc.width(); ++x) {
            const float radius = coc(x, y);
            view(x, y) = std::abs(radius) / largest.either() * (radius < 0 ? kNearColour : kFarColour);
            view(x, y).a = 1;
        }
    std::vector<Entry> legend = legend_of(largest, "SHARP     BLACK");
    legend[1].colour = {0, 0, 0, 1};
    draw_legend(view.view(), title, legend);
    return view;
}

}  // namespace petzval
