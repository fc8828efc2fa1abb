#include "device/cpu/gather.h"

#include "base/parallel.h"
#include "base/workspaces.h"
#include "device/cpu/gather_blocks.h"
#include "device/cpu/gather_planes.h"
#include "laws/compositing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace petzval::device {
namespace {

using engine::GatherPlan;
using laws::kLeastGathered;
using namespace gathering;

class TileGather {
public:
    TileGather(const GatherPlan& plan, const GatherPlan::Tile& tile, const TapAtlas& atlas,
               Workspace& workspace)
        : plan_(plan), atlas_(atlas), tile_(tile.pixels), w_(workspace) {}

    void run(const GatheredBlocks& blocks, View<Rgba> out) {
        w_.tile.reset(tile_.width(), tile_.height());
        for (const LevelBlocks& of : blocks.groups())
            if (of.group.level == 0)
                combine_turns(plan_, atlas_, of.group, tile_, w_, w_.tile);
            else
                enlarge(of);
        write(out);
    }

private:
    void enlarge(const LevelBlocks& of) {
        const Rect target = GatherPlan::cells_of(tile_, of.group.level);
        const Rect lit = of.copy(target, w_.cells);
        if (!lit.empty()) enlarge(of.group.level, target, lit);
    }

    // Gives the tile's pixels the combined result of a coarse group, if cells around them are lit.
    void enlarge(int level, const Rect& target, const Rect& lit) {
        const float per_cell = 1 / float(1 << level);
        w_.cell_of.clear(), w_.right_of.clear();
        for (int x = 0; x < tile_.width(); ++x) {
            const float at = (float(tile_.x0 + x) + 0.5f) * per_cell - 0.5f - float(target.x0);
            w_.cell_of.push_back(int(at)), w_.right_of.push_back(at - float(int(at)));
        }
        const auto first_from = [&](int cell) {
            return int(std::lower_bound(w_.cell_of.begin(), w_.cell_of.end(), cell) - w_.cell_of.begin());
        };
        const int x0 = first_from(lit.x0 - 1), x1 = first_from(lit.x1);
        if (x0 == x1) return;
        w_.lines.shape(Combined::kCount + 3, std::max(tile_.width(), target.width()), 1);
        for (int y = 0; y < tile_.height(); ++y) {
            const float at_y = (float(tile_.y0 + y) + 0.5f) * per_cell - 0.5f - float(target.y0);
            const int row = int(at_y);
            if (row >= lit.y0 - 1 && row < lit.y1) enlarge_row(y, row, at_y - float(row), x0, x1);
        }
    }

    // Pixels x0…x1-1 of row y, which lies `below` beyond the middle of a row of cells.
    void enlarge_row(int y, int row, float below, int x0, int x1) {
        const int n = x1 - x0, first = w_.cell_of[std::size_t(x0)],
                  last = w_.cell_of[std::size_t(x1 - 1)] + 1;
        const int* cell = w_.cell_of.data() + x0;
        const float* right = w_.right_of.data() + x0;
        float *line = w_.lines.plane(Combined::kCount), *area = w_.lines.plane(Combined::kCount + 1),
              *scale = w_.lines.plane(Combined::kCount + 2);
        for (int k = 0; k < Combined::kCount; ++k) {
            const float *a = w_.cells.planes.row(k, row), *b = w_.cells.planes.row(k, row + 1);
            for (int x = first; x <= last; ++x) line[x] = a[x] + below * (b[x] - a[x]);
            float* const value = w_.lines.plane(k);
            for (int x = 0; x < n; ++x)
                value[x] = line[cell[x]] + right[x] * (line[cell[x] + 1] - line[cell[x]]);
        }
        const float* const free = w_.lines.plane(Combined::kFree);
        for (int x = 0; x < n; ++x) area[x] = 1 - free[x];
        take_area(n, area, area, w_.tile.planes.row(Combined::kFree, y) + x0, scale);
        for (int k = 0; k < Combined::kFree; ++k)
            add_scaled(n, scale, w_.lines.plane(k), w_.tile.planes.row(k, y) + x0);
    }

    void write(View<Rgba> out) {
        for (int y = 0; y < tile_.height(); ++y) {
            Planes& p = w_.tile.planes;
            const float *r = p.row(kRed, y), *g = p.row(kGreen, y), *b = p.row(kBlue, y),
                        *a = p.row(Combined::kSumAlpha, y), *free = p.row(Combined::kFree, y);
            for (int x = 0; x < tile_.width(); ++x) {
                const float taken = 1 - free[x];
                const float scale = taken > kLeastGathered ? 1 / taken : 0;
                out(tile_.x0 + x, plan_.first_row + tile_.y0 + y) = Rgba{r[x], g[x], b[x], a[x]} * scale;
            }
        }
    }

    const GatherPlan& plan_;
    const TapAtlas& atlas_;
    Rect tile_;
    Workspace& w_;
};

void copy_tile(const GatherPlan& plan, const Rect& tile, View<Rgba> out) {
    for (int y = tile.y0; y < tile.y1; ++y)
        std::copy_n(plan.strip.samples.colour.row(y) + tile.x0, tile.width(),
                    out.row(plan.first_row + y) + tile.x0);
}

}  // namespace

void gather_tiles(const GatherPlan& plan, const TapAtlas& atlas, View<Rgba> out, const Control& control) {
    const Control half{control.workers, control.progress, control.share / 2};
    const GatheredBlocks blocks(plan, atlas, half);
    Workspaces<Workspace> workspaces;
    const double share = half.share / double(plan.tiles.size());
    parallel_for(int(plan.tiles.size()), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        const GatherPlan::Tile& tile = plan.tiles[std::size_t(i)];
        if (tile.is_sharp) {
            copy_tile(plan, tile.pixels, out);
        } else {
            const auto workspace = workspaces.take();
            TileGather(plan, tile, atlas, *workspace).run(blocks, out);
        }
        control.progress.advance(share);
    });
}

}  // namespace petzval::device
