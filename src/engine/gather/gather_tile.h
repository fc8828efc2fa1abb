// One tile of the output: rings gathered at the resolution of their level, then combined by lens area.
//
// Rings are taken from the nearest to the farthest. Each takes of every pixel's lens the area it arrives
// with, or what is left: what is near hides what is far, whatever its colour. What nothing took goes to what
// was seen, in proportion. Rings of one level that follow each other are combined on that level's grid and
// enlarged together (bilinear, the tent).
#pragma once

#include "engine/gather/gather_cells.h"

#include <memory>

namespace petzval::engine {

struct GatherSource {
    const Input& input;
    const RingSizes& sizes;
    const RingKernels& kernels;
    const BlockFill& fill;
    const std::vector<CellLevel>& levels;  // [0] is for level 1
    bool opaque;                           // alpha is coverage: every pixel of the picture has alpha 1
};

// Scratch of the workers that gather, kept from tile to tile.
class GatherScratch {
public:
    GatherScratch();
    ~GatherScratch();
    GatherScratch(const GatherScratch&) = delete;
    GatherScratch& operator=(const GatherScratch&) = delete;
    struct Pool;
    Pool& pool() { return *pool_; }

private:
    std::unique_ptr<Pool> pool_;
};

void gather_tile(const GatherSource& source, const Rect& tile, GatherScratch& scratch, View<Rgba> out);

}  // namespace petzval::engine
