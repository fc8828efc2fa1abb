#include "device/cpu/gather_blocks.h"

#include "base/parallel.h"
#include "base/workspaces.h"

#include <algorithm>
#include <utility>

namespace petzval::device::gathering {
namespace {

using engine::GatherPlan;

constexpr int kBlock = 64;  // cells on a side

// Calls visit(index) for the blocks of a level that hold cells of `target`.
template <typename Visit>
void for_each_block(const LevelBlocks& of, const Rect& target, const Visit& visit) {
    const int rows = int(of.blocks.size()) / of.columns;
    const auto block_of = [](int cell) { return (cell + 1) / kBlock; };
    for (int by = block_of(target.y0); by <= std::min(block_of(target.y1 - 1), rows - 1); ++by)
        for (int bx = block_of(target.x0); bx <= std::min(block_of(target.x1 - 1), of.columns - 1); ++bx)
            visit(std::size_t(by * of.columns + bx));
}

LevelBlocks blocks_of(const GatherPlan& plan, const TurnGroup& group) {
    LevelBlocks of;
    of.group = group;
    if (group.level == 0) return of;
    const engine::CellLevel& level = plan.levels[std::size_t(group.level - 1)];
    const Rect all = Rect{0, 0, level.width(), level.height()}.grown(GatherPlan::kTentBorder);
    of.columns = (all.width() + kBlock - 1) / kBlock;
    for (int y = all.y0; y < all.y1; y += kBlock)
        for (int x = all.x0; x < all.x1; x += kBlock) {
            of.blocks.emplace_back();
            of.blocks.back().cells = Rect{x, y, x + kBlock, y + kBlock}.intersected(all);
        }
    for (const GatherPlan::Tile& tile : plan.tiles)
        if (!tile.is_sharp)
            for_each_block(of, GatherPlan::cells_of(tile.pixels, group.level),
                           [&](std::size_t i) { of.blocks[i].is_read = true; });
    return of;
}

}  // namespace

Rect LevelBlocks::copy(const Rect& target, Combined& to) const {
    Rect lit;
    for_each_block(*this, target, [&](std::size_t i) {
        const Block& block = blocks[i];
        const Rect here = block.lit.intersected(target);
        if (here.empty()) return;
        if (lit.empty()) to.reset(target.width(), target.height());
        for (int k = 0; k < Combined::kCount; ++k)
            for (int y = here.y0; y < here.y1; ++y)
                std::copy_n(block.combined.planes.row(k, y - block.cells.y0) + here.x0 - block.cells.x0,
                            here.width(), to.planes.row(k, y - target.y0) + here.x0 - target.x0);
        lit = lit.empty() ? here
                          : Rect{std::min(lit.x0, here.x0), std::min(lit.y0, here.y0),
                                 std::max(lit.x1, here.x1), std::max(lit.y1, here.y1)};
    });
    return lit.moved(-target.x0, -target.y0);
}

GatheredBlocks::GatheredBlocks(const GatherPlan& plan, const TapAtlas& atlas, const Control& control) {
    std::vector<std::pair<std::size_t, std::size_t>> read;  // group and block
    for (const TurnGroup& group : turn_groups(plan.sizes)) {
        groups_.push_back(blocks_of(plan, group));
        for (std::size_t i = 0; i < groups_.back().blocks.size(); ++i)
            if (groups_.back().blocks[i].is_read) read.emplace_back(groups_.size() - 1, i);
    }
    Workspaces<Workspace> workspaces;
    const double share = control.share / double(std::max<std::size_t>(1, read.size()));
    parallel_for(int(read.size()), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        LevelBlocks& of = groups_[read[std::size_t(i)].first];
        LevelBlocks::Block& block = of.blocks[read[std::size_t(i)].second];
        const auto workspace = workspaces.take();
        block.lit = combine_turns(plan, atlas, of.group, block.cells, *workspace, block.combined)
                        .moved(block.cells.x0, block.cells.y0);
        control.progress.advance(share);
    });
}

}  // namespace petzval::device::gathering
