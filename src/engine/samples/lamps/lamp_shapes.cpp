#include "engine/samples/lamps/lamp_shapes.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

Lamp LampFinder::lamp_at(int x, int y) {
    Lamp lamp;
    if (seen_(x, y)) return lamp;
    lamp.bounds = {x, y, x + 1, y + 1};
    std::vector<LampPixel> open{{x, y}};
    seen_(x, y) = 1;
    while (!open.empty()) {
        const LampPixel p = open.back();
        open.pop_back();
        add(p, lamp);
        for (int v = p.y - 1; v <= p.y + 1; ++v)
            for (int u = p.x - 1; u <= p.x + 1; ++u) visit({u, v}, light_.coc_px(p.x, p.y), lamp, open);
    }
    if (float(std::max(lamp.bounds.width(), lamp.bounds.height())) > completion_model.lit_widest_px)
        lamp.pixels.clear();
    return lamp;
}

void LampFinder::add(LampPixel p, Lamp& lamp) const {
    const float light = luminance(light_.at(p.x, p.y));
    lamp.pixels.push_back(p);
    lamp.bounds = {std::min(lamp.bounds.x0, p.x), std::min(lamp.bounds.y0, p.y),
                   std::max(lamp.bounds.x1, p.x + 1), std::max(lamp.bounds.y1, p.y + 1)};
    lamp.lit += double(light), lamp.lit_x += double(light) * p.x, lamp.lit_y += double(light) * p.y;
    if (light > lamp.peak) lamp.peak = light, lamp.coc_px = light_.coc_px(p.x, p.y);
}

// Visits a pixel from a neighbour of this radius.
void LampFinder::visit(LampPixel p, float coc, Lamp& lamp, std::vector<LampPixel>& open) {
    if (!light_.contains(p.x, p.y)) return;
    if (const float hides = light_.hides(p.x, p.y, coc); hides > 0) {
        lamp.cuts += double(hides), lamp.cut_x += double(hides) * p.x, lamp.cut_y += double(hides) * p.y;
        return;
    }
    if (seen_(p.x, p.y) || light_.at(p.x, p.y) == Rgba{}) return;
    const float other = light_.coc_px(p.x, p.y);
    if (std::abs(other - coc) > 1.5f + 0.1f * std::abs(coc)) return;
    seen_(p.x, p.y) = 1;
    open.push_back(p);
}

}  // namespace petzval::engine
