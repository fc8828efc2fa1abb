// Kernels of lenses whose halo is wide: most of such a kernel is smooth, and is drawn in cells of several
// pixels. Only as far from the source as cells show structure is it drawn in pixels.
#pragma once

#include "kernel/model/lens_model.h"

namespace petzval::kernel {

// Width of the cells for a kernel that reaches size_px, a power of 2: 32 to 64 of them from the source
// outwards. 1: the kernel is small, and is drawn in pixels alone.
int halo_cell_px(double size_px);

// Distance from the source, in pixels, of the farthest cell that stands out from its neighbours.
// cells: the whole kernel.
int structure_px(const PointSpread& cells, int cell_px);

// Joins two drawings of one kernel. `fine` is drawn in pixels and complete up to `radius_px`; `cells`
// continue it up to `reach_px`, where the kernel ends.
PointSpread with_halo(const PointSpread& fine, const PointSpread& cells, int cell_px, int radius_px,
                      double reach_px);

}  // namespace petzval::kernel
