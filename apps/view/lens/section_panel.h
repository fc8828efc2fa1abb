// The lens in section, with parts that can be dragged.
#pragma once

#include "app.h"

#include <imgui.h>

namespace petzval::view {

// A rectangle on the screen.
struct Box {
    ImVec2 from, to;
    float width() const { return to.x - from.x; }
    float height() const { return to.y - from.y; }
    ImVec2 middle() const { return {0.5f * (from.x + to.x), 0.5f * (from.y + to.y)}; }
};

// Draws into the box of the last item. The stop, the sensor and rims of the barrel can be dragged.
void draw_section(App& app, const Box& box);
// Makes the last item, a disc in this box, draggable: sideways changes the number of blades, at its rim turns
// them.
void drag_blades(App& app, const Box& box, const std::string& name);

}  // namespace petzval::view
