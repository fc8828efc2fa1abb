// The picture: drawn, zoomed, clicked on.
#pragma once

#include "app.h"

namespace petzval::view {

// Into ImGui's current window, all of it. What the mouse does there becomes commands.
void draw_canvas(App& app);

// What is shown there: "scatter", "sharp", "cpu".
std::string name_of_side(const App& app, const Side& side);

}  // namespace petzval::view
