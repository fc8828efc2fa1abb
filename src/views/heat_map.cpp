#include "petzval/views.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval {
namespace {

constexpr float kLowest = 0.1f;  // codes of 255
constexpr Rgba kInk{0.9f, 0.9f, 0.9f, 1}, kPaper{0.01f, 0.01f, 0.01f, 1};

Rgba mixed(const Rgba& a, const Rgba& b, float t) {
    Rgba mix = (1 - t) * a;
    mix += t * b;
    return mix;
}

// share: 0…1 of the logarithmic scale.
Rgba heat(float share) {
    const std::array<Rgba, 5> stops{
        Rgba{0, 0, 0, 1}, {0.01f, 0.06f, 0.25f, 1}, kNearColour, kFarColour, {1, 1, 1, 1}};
    const float at = std::clamp(share, 0.0f, 1.0f) * float(stops.size() - 1);
    const std::size_t i = std::min(std::size_t(at), stops.size() - 2);
    return mixed(stops[i], stops[i + 1], at - float(i));
}

float share_of(float error) { return std::log(255 * error / kLowest) / std::log(255 / kLowest); }

void fill(Picture& picture, const Rect& area, const Rgba& colour) {
    const Rect seen = area.intersected(picture.rect());
    for (int y = seen.y0; y < seen.y1; ++y)
        for (int x = seen.x0; x < seen.x1; ++x) picture(x, y) = colour;
}

// A frame of that thickness along the inside of the area.
void frame(Picture& picture, const Rect& area, int thick, const Rgba& colour) {
    fill(picture, {area.x0, area.y0, area.x1, area.y0 + thick}, colour);
    fill(picture, {area.x0, area.y1 - thick, area.x1, area.y1}, colour);
    fill(picture, {area.x0, area.y0, area.x0 + thick, area.y1}, colour);
    fill(picture, {area.x1 - thick, area.y0, area.x1, area.y1}, colour);
}

// White between black, so that it shows on light and dark.
void outline(Picture& picture, const Rect& area, const std::string& name, int scale) {
    frame(picture, area.grown(2 * scale), scale, kPaper);
    frame(picture, area.grown(scale), scale, kInk);
    frame(picture, area, scale, kPaper);
    const int high = text_height_px(scale), wide = text_width_px(name, scale), margin = 2 * scale;
    const int above = area.y0 - high - 2 * margin;
    const int y = above >= 0 ? above : area.y1 + margin;
    fill(picture, {area.x0 - scale, y, area.x0 + wide + margin, y + high + 2 * scale}, kPaper);
    draw_text(picture, area.x0, y + scale, name, scale, kInk);
}

void legend(Picture& picture, int scale) {
    const int wide = 120 * scale, high = 6 * scale, left = 6 * scale;
    const int top = picture.height() - high - text_height_px(scale) - 6 * scale;
    if (wide + 2 * left > picture.width() || top < picture.height() / 2) return;
    fill(picture, {left - 2 * scale, top - 2 * scale, left + wide + 14 * scale, picture.height()}, kPaper);
    for (int x = 0; x < wide; ++x)
        for (int y = 0; y < high; ++y) picture(left + x, top + y) = heat((float(x) + 0.5f) / float(wide));
    for (const int codes : {1, 10, 100}) {
        const int x = int(share_of(float(codes) / 255) * float(wide));
        draw_text(picture, left + x, top + high + 2 * scale, std::to_string(codes), scale, kInk);
    }
}

}  // namespace

Picture heat_map(View<const float> error, const std::vector<Rect>& places) {
    Picture picture(error.width(), error.height(), {0, 0, 0, 1});
    for (int y = 0; y < error.height(); ++y)
        for (int x = 0; x < error.width(); ++x)
            if (255 * error(x, y) > kLowest) picture(x, y) = heat(share_of(error(x, y)));
    const int scale = std::clamp(error.width() / 640, 1, 4);
    for (std::size_t i = 0; i < places.size(); ++i) outline(picture, places[i], std::to_string(i + 1), scale);
    legend(picture, scale);
    return picture;
}

}  // namespace petzval
