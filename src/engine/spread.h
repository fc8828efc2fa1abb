// Spreading sources over tiles: kernels from a table, stamped on each level's grid, brought up to full
// resolution.
#pragma once

#include "engine/sources.h"
#include "kernel/lens_model.h"

#include <vector>

namespace petzval::engine {

// Kernels of one lens at finely stepped radii, in cells of any level.
class SpreadTable {
public:
    SpreadTable(const kernel::LensModel& lens, float largest_radius);
    const kernel::PointSpread& at(float radius) const;

private:
    std::vector<kernel::PointSpread> near_, far_;
};

// All layers of a tile, nearest first: light and lens area arriving at each of its pixels.
std::vector<Picture> spread_layers(const SourceGrid& grid, const SpreadTable& table, const Rect& tile);

}  // namespace petzval::engine
