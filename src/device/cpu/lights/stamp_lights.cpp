#include "device/cpu/lights/stamp_lights.h"

#include "base/parallel.h"
#include "base/workspaces.h"
#include "device/cpu/lights/dimmer.h"
#include "engine/waist/cells.h"
#include "laws/tiles.h"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>

namespace petzval::device {

using namespace engine;

namespace {

constexpr int kBorder = laws::kStampedBorder;

// Adds cells of coarser levels to pixels bilinearly, which keeps their light.
void add_cells(const Accumulator& cells, int level, const LightsPlan& plan, const Rect& tile,
               View<Rgba> out) {
    const float per_cell = 1 / float(1 << level);
    const float per_pixel = per_cell * per_cell;
    for (int y = tile.y0; y < tile.y1; ++y) {
        Rgba* to = out.row(plan.first_row + y);
        if (level == 0) {
            const Rgba* from = cells.row(y) - tile.x0;
            for (int x = tile.x0; x < tile.x1; ++x) to[x] += from[x];
            continue;
        }
        const float at_y = (float(y) + 0.5f) * per_cell - 0.5f;
        const int top = int(std::floor(at_y));
        const float below = at_y - float(top);
        const Rgba *a = cells.row(top) - cells.area().x0, *b = cells.row(top + 1) - cells.area().x0;
        for (int x = tile.x0; x < tile.x1; ++x) {
            const float at_x = (float(x) + 0.5f) * per_cell - 0.5f;
            const int left = int(std::floor(at_x));
            const float right = at_x - float(left);
            to[x] += per_pixel * ((1 - below) * ((1 - right) * a[left] + right * a[left + 1]) +
                                  below * ((1 - right) * b[left] + right * b[left + 1]));
        }
    }
}

// Memory one worker keeps from tile to tile.
struct Workspace {
    Accumulator cells;
    Dimmer dimmer;
};

class TileStamper {
public:
    TileStamper(const LightsPlan& plan, const StampAtlas& atlas, std::size_t tile, Workspace& w)
        : plan_(plan), atlas_(atlas), tile_(plan.tiles[tile].pixels), w_(w) {
        const std::size_t begin = plan.tiles[tile].first_light, end = plan.tiles[tile + 1].first_light;
        order_ = std::span(plan.order).subspan(begin, end - begin);
    }

    // Returns the number of stamped taps.
    std::size_t run(View<Rgba> out) {
        for (std::size_t i = 0; i < order_.size();) {
            const int level = level_of(i);
            w_.cells.reset(cells_of(tile_, level, kBorder));
            while (i < order_.size() && level_of(i) == level) i = stamp_kernel(i);
            add_cells(w_.cells, level, plan_, tile_, out);
        }
        return taps_;
    }

private:
    const PlannedLight& light(std::size_t i) const { return plan_.lights[order_[i]]; }
    int level_of(std::size_t i) const { return plan_.kernels.asks[light(i).kernel].level; }
    const PupilMask& mask(std::size_t i) const { return plan_.masks[light(i).viewpoint]; }
    // True if the next light has the same kernel and position.
    bool is_same_as_next(std::size_t i) const {
        if (i + 1 == order_.size() || !mask(i).is_open() || !mask(i + 1).is_open()) return false;
        const PlannedLight &a = light(i), &b = light(i + 1);
        return a.kernel == b.kernel && a.highlight.x == b.highlight.x && a.highlight.y == b.highlight.y;
    }

    // Stamps all lights from `begin` on that share its kernel; returns the next.
    std::size_t stamp_kernel(std::size_t begin) {
        const PlannedLight& first = light(begin);
        const StampSet& set = atlas_[first.kernel];
        const StampKernel& kernel = set.kernels.front();
        bool ready = false;
        std::size_t i = begin;
        for (; i < order_.size() && light(i).kernel == first.kernel; ++i) {
            const Highlight& h = light(i).highlight;
            Rgba sum = h.colour;
            for (; is_same_as_next(i); ++i) sum += light(i + 1).highlight.colour;
            taps_ += set.taps;
            if (mask(i).is_open()) {
                stamp({&kernel, 1}, h.x, h.y, sum, 0, 0, {&w_.cells, 1});
                continue;
            }
            if (!ready)
                w_.dimmer.use(kernel, std::ldexp(first.highlight.coc_px, -level_of(begin)), plan_.stretch);
            ready = true;
            stamp_dimmed(kernel, h.x, h.y, sum, w_.dimmer.rows(mask(i)), w_.cells);
        }
        return i;
    }

    const LightsPlan& plan_;
    const StampAtlas& atlas_;
    Rect tile_;
    Workspace& w_;
    std::span<const std::uint32_t> order_;
    std::size_t taps_ = 0;
};

}  // namespace

Work stamp_planned_lights(const LightsPlan& plan, const StampAtlas& atlas, View<Rgba> out,
                          const Control& control) {
    Workspaces<Workspace> workspaces;
    std::atomic<std::size_t> taps = 0;
    parallel_for(int(plan.tiles.size()) - 1, control.workers, [&](int tile) {
        if (control.progress.cancelled()) return;
        const auto workspace = workspaces.take();
        taps += TileStamper(plan, atlas, std::size_t(tile), *workspace).run(out);
    });
    return Work::of_taps(taps);
}

}  // namespace petzval::device
