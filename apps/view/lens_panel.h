// The lens beside the picture.
#pragma once

#include "app.h"

#include <cstddef>
#include <vector>

namespace petzval::view {

// Into ImGui's current window, all of it.
void draw_lens(App& app);
// Of the section's rays those that land near the place that is lit.
std::vector<std::size_t> lit_rays(const App& app);

}  // namespace petzval::view
