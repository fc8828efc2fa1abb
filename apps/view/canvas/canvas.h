// The picture: drawn, zoomed, clicked on.
#pragma once

#include "app.h"

namespace petzval::view {

// Fills ImGui's current window. Mouse actions become commands.
void draw_canvas(App& app);

// Name of the side's content: "scatter", "sharp", "cpu".
std::string name_of_side(const App& app, const Side& side);

}  // namespace petzval::view
