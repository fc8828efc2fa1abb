// Combined light of coarse levels, in square blocks of cells: a block is gathered once for all tiles of
// pixels that read it.
#pragma once

#include "device/cpu/gather_turns.h"

#include <memory>
#include <vector>

namespace petzval::device::gathering {

// The blocks of one group. Its level's cells begin at -1: enlarging reads one cell around the picture.
struct LevelBlocks {
    struct Block {
        Rect cells, lit;    // of the level; light landed in `lit` alone
        Combined combined;  // counted from the first of the cells
        bool is_read = false;
    };
    // Copies the light of the blocks within `target`. Returns the lit rectangle, counted from the first cell
    // of `target`.
    Rect copy(const Rect& target, Combined& to) const;

    TurnGroup group;
    int columns = 0;
    std::vector<Block> blocks;  // row by row; none of level 0, which tiles combine themselves
};

class GatheredBlocks {
public:
    // Gathers the blocks that any blurred tile reads.
    GatheredBlocks(const engine::GatherPlan& plan, const TapAtlas& atlas, const Control& control);
    const std::vector<LevelBlocks>& groups() const { return groups_; }

private:
    std::vector<LevelBlocks> groups_;
};

}  // namespace petzval::device::gathering
