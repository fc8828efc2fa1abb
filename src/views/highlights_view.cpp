#include "views/plan_view.h"

namespace petzval::views {

using engine::Highlight;

void HighlightsView::read(const engine::PlannedStrip& strip) {
    const engine::EngineView& input = strip.input;
    const int width = input.width(), height = input.height();
    shown_.image = Picture(2 * width, height);
    const Rect drawn{0, 0, width, height}, taken{width, 0, 2 * width, height};
    shown_.panels = {{"HIGHLIGHTS  EACH DRAWN WITH ITS WHOLE KERNEL", drawn, {}, ""},
                     {"TAKEN  FROM THE SHARP PICTURE", taken, {}, "taken"}};
    for (const Highlight& h : strip.highlights)
        for (int y = h.y; y < h.y + h.size; ++y)
            for (int x = h.x; x < h.x + h.size; ++x) {
                Rgba& pixel = shown_.image(width + x, y);
                pixel += h.colour, pixel.a = 1;
            }
    draw_lights(strip, shown_.image.view().part(drawn));
    input.services.progress->advance(1);
}

}  // namespace petzval::views
