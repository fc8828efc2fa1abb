// The picture: drawn, zoomed, clicked on.
#pragma once

#include "app.h"

namespace petzval::view {

// Into ImGui's current window, all of it. What the mouse does there becomes commands.
void draw_canvas(App& app);

}  // namespace petzval::view
