// The lens in section, and what can be grabbed in it.
#pragma once

#include "app.h"

#include <imgui.h>

namespace petzval::view {

// Of the screen.
struct Box {
    ImVec2 from, to;
    float width() const { return to.x - from.x; }
    float height() const { return to.y - from.y; }
    ImVec2 middle() const { return {0.5f * (from.x + to.x), 0.5f * (from.y + to.y)}; }
};

// Into the box that was the last item. The stop, the sensor and rims of the barrel can be dragged.
void draw_section(App& app, const Box& box);
// Of the last item, a disc in this box: dragged sideways it gets more blades or fewer, at its rim they turn.
void drag_blades(App& app, const Box& box, const std::string& name);

}  // namespace petzval::view
