// A grid of square cells, to find what lies near a pixel.
#pragma once

#include <algorithm>

namespace petzval::engine {

constexpr int kCell = 16;  // pixels on a side

// The column or row of a pixel in a grid of `cells` columns or rows; those beyond count as the outermost.
inline int cell_of(int at_px, int cells) { return std::clamp(at_px / kCell, 0, cells - 1); }

}  // namespace petzval::engine
