#include "petzval/views.h"

#include <algorithm>
#include <cmath>

namespace petzval {
namespace {

// The panel's name at its top left, behind a swatch of its colour; the largest letters that fit.
void label(View<Rgba> picture, const Panel& panel) {
    const Rect& r = panel.area;
    int scale = std::clamp(r.width() / 420, 1, 4);
    const bool swatch = panel.colour != Rgba{};
    std::string text = panel.name;
    if (const std::size_t first = text.find("  ");
        text_width_px(text, scale) + 3 * text_height_px(scale) > r.width() && first != std::string::npos)
        text.resize(first);
    const int high = text_height_px(scale), margin = 2 * scale;
    const int wide = text_width_px(text, scale) + (swatch ? 2 * high : 0);
    if (wide + 2 * margin > r.width() || high + 2 * margin > r.height()) return;
    for (int y = r.y0; y < r.y0 + high + 2 * margin; ++y)
        for (int x = r.x0; x < r.x0 + wide + 2 * margin; ++x) picture(x, y) = {0.01f, 0.01f, 0.01f, 1};
    const int top = r.y0 + margin, left = r.x0 + margin;
    for (int y = 0; swatch && y < high; ++y)
        for (int x = 0; x < high; ++x) picture(left + x, top + y) = panel.colour;
    draw_text(picture, left + (swatch ? 2 * high : 0), top, text, scale, {0.8f, 0.8f, 0.8f, 1});
}

}  // namespace

Rgba colour_of_number(float number) {
    constexpr float kTones[] = {1, 0.4f, 0.16f, 0.06f};
    if (std::isnan(number)) return {0, 0, 0, 1};
    if (number == 0) return {1, 1, 1, 1};
    const Rgba colour = number < 0 ? kNearColour : kFarColour;
    Rgba toned = kTones[int(std::abs(number) - 1) % 4] * colour;
    toned.a = 1;
    return toned;
}

Picture shown(const Picture& light, const DevelopSettings& settings) {
    const auto codes = develop(light.view(), settings);
    const double largest = (1 << settings.bits) - 1;
    Picture display(light.width(), light.height());
    const auto value = [&](std::size_t i) { return float(srgb_decode(codes[i] / largest)); };
    for (std::size_t i = 0; i < display.size(); ++i)
        display.pixels()[i] = {value(3 * i), value(3 * i + 1), value(3 * i + 2), 1};
    return display;
}

Picture drawn_panels(const Picture& atlas, const std::vector<Panel>& panels,
                     const DevelopSettings& settings) {
    Picture display = shown(atlas, settings);
    for (const Panel& p : panels) {
        const Rect& r = p.area;
        for (int y = r.y0; p.is_numbers && y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) display(x, y) = colour_of_number(atlas(x, y).r);
        label(display.view(), p);
    }
    return display;
}

std::string places_of(const std::vector<Panel>& panels) {
    std::string places;
    for (const Panel& p : panels)
        places += p.name + ": " + std::to_string(p.area.width()) + " x " + std::to_string(p.area.height()) +
                  " at " + std::to_string(p.area.x0) + "," + std::to_string(p.area.y0) + "; ";
    return places;
}

std::vector<PanelPlane> planes_of(const Picture& atlas, const std::vector<Panel>& panels) {
    std::vector<PanelPlane> planes;
    for (const Panel& p : panels) {
        if (!p.layer) return {};
        const auto take = [&](const std::string& channel, float Rgba::*part) {
            Plane values(p.area.width(), p.area.height());
            for (int y = 0; y < values.height(); ++y)
                for (int x = 0; x < values.width(); ++x)
                    values(x, y) = atlas(p.area.x0 + x, p.area.y0 + y).*part;
            planes.push_back({channel, std::move(values)});
        };
        if (p.is_numbers) {
            take(*p.layer, &Rgba::r);
            continue;
        }
        const std::string prefix = p.layer->empty() ? "" : *p.layer + ".";
        take(prefix + "R", &Rgba::r), take(prefix + "G", &Rgba::g);
        take(prefix + "B", &Rgba::b), take(prefix + "A", &Rgba::a);
    }
    return planes;
}

}  // namespace petzval
