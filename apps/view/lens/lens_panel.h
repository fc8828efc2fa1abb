// The lens beside the picture.
#pragma once

#include "app.h"

#include <cstddef>
#include <vector>

namespace petzval::view {

// Fills ImGui's current window.
void draw_lens(App& app);
// Rays of the section that land near the lit position.
std::vector<std::size_t> lit_rays(const App& app);

}  // namespace petzval::view
