// Rectangles of the pupil that nearer things cover, added up on a grid.
#pragma once

#include "engine/lights/shadow_plan.h"

#include <cstddef>
#include <span>

namespace petzval::device {

// A grid over the square that holds the pupil, with room for kSpill floats beyond each row.
struct CoveredCells {
    static constexpr int kSpill = 16;
    float* covered = nullptr;
    std::ptrdiff_t stride = 0;  // floats from row to row
    int side = 0;               // in cells
    float per_radius = 0;       // cells; negative where the grid is the pupil turned by 180 degrees
};

// Adds to each cell the share of it that each rectangle covers, times its coverage.
void cover(const CoveredCells& cells, std::span<const engine::SeenCaster> casters);

// Sets the share of each cell that is left open; rectangles that overlap may cover more than all of it.
void find_open(std::span<const float> covered, float* open);

}  // namespace petzval::device
