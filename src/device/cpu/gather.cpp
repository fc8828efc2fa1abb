#include "device/cpu/gather.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/workspaces.h"
#include "device/cpu/gather_planes.h"
#include "device/cpu/gather_taps.h"
#include "laws/compositing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace petzval::device {
namespace {

using engine::CellLevel;
using engine::CellLight;
using engine::GatherPlan;
using engine::kGatherGroup;
using engine::kGatherRows;
using engine::OpenEdges;
using laws::kLeastGathered;
using namespace gathering;

class TileGather {
public:
    TileGather(const GatherPlan& plan, const GatherPlan::Tile& tile, const TapAtlas& atlas,
               Workspace& workspace)
        : plan_(plan), atlas_(atlas), tile_(tile.pixels), w_(workspace) {}

    void run(View<Rgba> out) {
        w_.tile.reset(tile_.width(), tile_.height());
        w_.arrivals.resize(std::size_t(plan_.sizes.entries()));
        w_.grids.resize(std::size_t(plan_.sizes.levels()));
        for (int level = 0; level < plan_.sizes.levels(); ++level) find_grid(level);
        const int turns = int(plan_.sizes.turns().size());
        for (int begin = 0; begin < turns;) {
            const int level = plan_.sizes.level_of_turn(begin);
            int end = begin;
            while (end < turns && plan_.sizes.level_of_turn(end) == level) ++end;
            group(begin, end, level);
            begin = end;
        }
        write(out);
    }

private:
    // Turns begin…end-1, all of one level.
    void group(int begin, int end, int level) {
        const Grid& grid = w_.grids[std::size_t(level)];
        if (!find_arrivals(begin, end, grid)) return;
        Combined& into = level == 0 ? w_.tile : w_.cells;
        if (level > 0) into.reset(grid.target.width(), grid.target.height());
        Rect lit{grid.target.width(), grid.target.height(), 0, 0};
        for (int turn = begin; turn < end; ++turn) {
            gather_turn(turn, grid);
            if (reached_.empty()) continue;
            lit = {std::min(lit.x0, reached_.x0), std::min(lit.y0, reached_.y0),
                   std::max(lit.x1, reached_.x1), std::max(lit.y1, reached_.y1)};
            take(into);
        }
        if (level > 0 && !lit.empty()) enlarge(grid, lit);
    }

    // Light beyond the picture is spread like the border that it repeats.
    void find_grid(int level) {
        Grid& grid = w_.grids[std::size_t(level)];
        grid.level = level, grid.target = GatherPlan::cells_of(tile_, level);
        grid.window = grid.target.grown(plan_.reach[std::size_t(level)]);
        const bool pixels = level == 0;
        const int width = pixels ? plan_.strip.width() : plan_.levels[std::size_t(level - 1)].width();
        const int height = pixels ? plan_.strip.height() : plan_.levels[std::size_t(level - 1)].height();
        const auto middle = [&](int cell, int cells) {
            return std::ldexp(std::clamp(cell, 0, cells - 1) + 0.5, level) - 0.5;
        };
        grid.zone_column.clear(), grid.zone_row.clear();
        for (int x = grid.window.x0; x < grid.window.x1; ++x)
            grid.zone_column.push_back(plan_.zones.column_of(middle(x, width)));
        for (int y = grid.window.y0; y < grid.window.y1; ++y)
            grid.zone_row.push_back(plan_.zones.row_of(middle(y, height)) * plan_.zones.columns);
    }

    // Finds light of turns begin…end-1 and of their skirts; returns whether there is any.
    bool find_arrivals(int begin, int end, const Grid& grid) {
        const engine::RingSizes& sizes = plan_.sizes;
        const int first_skirt = sizes.skirt_entry(begin), last_skirt = sizes.skirt_entry(end);
        const auto clear = [&](int first, int last) {
            for (int entry = first; entry < last; ++entry) w_.arrivals[std::size_t(entry)].clear();
        };
        clear(begin, end), clear(first_skirt, last_skirt);
        has_beyond_ = false;
        if (grid.level == 0)
            find_in_picture(begin, end, grid);
        else
            find_in_cells(begin, end, grid);
        std::vector<bool> done(w_.grids.size());
        for (int turn = begin; turn < end; ++turn) {
            const int level = sizes.skirt_level(sizes.ring_of_entry(turn));
            if (level == 0 || done[std::size_t(level)]) continue;
            done[std::size_t(level)] = true;
            find_in_cells(first_skirt, last_skirt, w_.grids[std::size_t(level)]);
        }
        const auto any = [&](int first, int last) {
            return std::any_of(w_.arrivals.begin() + first, w_.arrivals.begin() + last,
                               [](const auto& arrivals) { return !arrivals.empty(); });
        };
        return any(begin, end) || any(first_skirt, last_skirt);
    }

    void arrive(int entry, int x, int y, const Grid& grid, Rgba colour, float covered, float beyond) {
        has_beyond_ = has_beyond_ || beyond > 0;
        x -= grid.window.x0, y -= grid.window.y0;
        const int zone = grid.zone_row[std::size_t(y)] + grid.zone_column[std::size_t(x)];
        w_.arrivals[std::size_t(entry)].push_back({x, y, zone, colour, covered, beyond});
    }

    // True if the picture continues at an outside position (x, y) as its nearest inside cell; otherwise there
    // is emptiness.
    bool goes_on(int x, int y, int width, int height) const {
        const OpenEdges& open = plan_.strip.window.open_edges;
        return (x >= 0 || open.left) && (x < width || open.right) && (y >= 0 || open.top) &&
               (y < height || open.bottom);
    }

    void find_in_picture(int begin, int end, const Grid& grid) {
        const int width = plan_.strip.width(), height = plan_.strip.height();
        const float largest_px = plan_.sizes.light_of(0).below_px;
        for (int y = grid.window.y0; y < grid.window.y1; ++y)
            for (int x = grid.window.x0; x < grid.window.x1; ++x) {
                const int u = std::clamp(x, 0, width - 1), v = std::clamp(y, 0, height - 1);
                const bool outside = u != x || v != y, on = !outside || goes_on(x, y, width, height);
                engine::for_each_sample(plan_.strip, plan_.guessed, u, v,
                                        [&](Rgba colour, float coc_px, float covered, bool hidden) {
                                            if (std::abs(coc_px) > largest_px) return;
                                            plan_.sizes.hand_out(coc_px, hidden, [&](int turn, float share) {
                                                if (turn < begin || turn >= end) return;
                                                arrive(turn, x, y, grid, outside ? Rgba{} : share * colour,
                                                       outside && on ? 0 : share * covered,
                                                       outside && on ? share * covered : 0);
                                            });
                                        });
            }
    }

    void find_in_cells(int begin, int end, const Grid& grid) {
        const CellLevel& cells = plan_.levels[std::size_t(grid.level - 1)];
        for (int y = grid.window.y0; y < grid.window.y1; ++y) {
            const int v = std::clamp(y, 0, cells.height() - 1);
            if (!cells.has_any(v)) continue;
            for (int x = grid.window.x0; x < grid.window.x1; ++x) {
                const int u = std::clamp(x, 0, cells.width() - 1);
                const bool outside = u != x || v != y;
                const bool on = outside && goes_on(x, y, cells.width(), cells.height());
                for (const CellLight& light : cells.at(u, v)) {
                    if (light.entry < begin || light.entry >= end) continue;
                    const float all = light.covered + light.beyond;
                    if (!outside)
                        arrive(light.entry, x, y, grid, light.colour, light.covered, light.beyond);
                    else
                        arrive(light.entry, x, y, grid, {}, on ? 0 : all, on ? all : 0);
                }
            }
        }
    }

    // The light of one turn, at every cell of its reach within the target.
    void gather_turn(int turn, const Grid& grid) {
        reached_ = {};
        const auto& skirts = w_.arrivals[std::size_t(plan_.sizes.skirt_entry(turn))];
        if (skirts.empty()) return gather_entry(turn, grid, w_.gathered, reached_);
        const int level = plan_.sizes.skirt_level(plan_.sizes.ring_of_entry(turn));
        const Grid& coarse = w_.grids[std::size_t(level)];
        Rect wide, core;
        gather_entry(plan_.sizes.skirt_entry(turn), coarse, w_.skirt, wide);
        gather_entry(turn, grid, w_.gathered, core);
        add_skirt(coarse, wide, grid, core);
    }

    // Light of each zone is gathered by its own kernel; `reached`: where in the target it lands, outside of
    // which `into` holds nothing.
    void gather_entry(int entry, const Grid& grid, Planes& into, Rect& reached) {
        const std::vector<Arrival>& arrivals = w_.arrivals[std::size_t(entry)];
        reached = {};
        w_.zones.clear();
        for (const Arrival& a : arrivals)
            if (std::find(w_.zones.begin(), w_.zones.end(), a.zone) == w_.zones.end())
                w_.zones.push_back(a.zone);
        if (w_.zones.empty()) return;
        if (w_.zones.size() == 1) {
            reached = gather_zone(entry, grid, w_.zones.front(), into);
            return;
        }
        shape(into, grid), into.clear(kPlanes);
        for (const int zone : w_.zones) {
            const Rect here = gather_zone(entry, grid, zone, w_.of_zone);
            for (int k = 0; k < planes_; ++k)
                for (int y = here.y0; y < here.y1; ++y) {
                    const float* from = w_.of_zone.row(k, y);
                    float* to = into.row(k, y);
                    for (int x = here.x0; x < here.x1; ++x) to[x] += from[x];
                }
            reached = with(reached, here);
        }
    }
    static Rect with(const Rect& a, const Rect& b) {
        if (a.empty() || b.empty()) return a.empty() ? b : a;
        return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
    }
    static void shape(Planes& planes, const Grid& grid) {
        planes.shape(kPlanes, grid.target.width() + kGatherGroup, grid.target.height() + kGatherRows);
    }

    // Adds skirts from a coarser grid, enlarged, to the cores that the turn gathered within `core`.
    void add_skirt(const Grid& coarse, const Rect& wide, const Grid& grid, const Rect& core) {
        const int width = grid.target.width(), height = grid.target.height();
        if (core.empty()) shape(w_.gathered, grid);
        for (int k = 0; k < planes_; ++k)
            for (int y = 0; y < height; ++y) {
                float* const row = w_.gathered.row(k, y);
                const bool inside = !core.empty() && y >= core.y0 && y < core.y1;
                std::fill(row, row + (inside ? core.x0 : width), 0.0f);
                if (inside) std::fill(row + core.x1, row + width, 0.0f);
            }
        reached_ = core;
        if (wide.empty()) return;
        const float per_cell = 1 / float(1 << (coarse.level - grid.level));
        const auto at = [&](int cell, int first, int coarse_first) {
            return (float(first + cell) + 0.5f) * per_cell - 0.5f - float(coarse_first);
        };
        w_.cell_of.clear(), w_.right_of.clear();
        for (int x = 0; x < width; ++x) {
            const float place = at(x, grid.target.x0, coarse.target.x0);
            w_.cell_of.push_back(int(place)), w_.right_of.push_back(place - float(int(place)));
        }
        const auto first_from = [&](int cell) {
            return int(std::lower_bound(w_.cell_of.begin(), w_.cell_of.end(), cell) - w_.cell_of.begin());
        };
        const Rect lands{first_from(wide.x0 - 1), 0, first_from(wide.x1), height};
        w_.lines.shape(1, coarse.target.width() + 1, 1);
        Rect landed{lands.x0, height, lands.x1, 0};
        for (int y = 0; y < height; ++y) {
            const float place = at(y, grid.target.y0, coarse.target.y0);
            const int row = int(place);
            if (row < wide.y0 - 1 || row >= wide.y1) continue;
            landed.y0 = std::min(landed.y0, y), landed.y1 = y + 1;
            add_skirt_row(row, place - float(row), wide, lands, y);
        }
        reached_ = with(reached_, landed);
    }
    void add_skirt_row(int row, float below, const Rect& wide, const Rect& lands, int y) {
        float* const line = w_.lines.plane(0);
        for (int k = 0; k < planes_; ++k) {
            // Outside `wide` the planes hold numbers of other turns.
            const auto share = [&](int of, float part) {
                if (of < wide.y0 || of >= wide.y1) return;
                const float* const from = w_.skirt.row(k, of);
                for (int x = wide.x0; x < wide.x1; ++x) line[x] += part * from[x];
            };
            std::fill(line + std::max(0, wide.x0 - 1), line + wide.x1 + 1, 0.0f);
            share(row, 1 - below), share(row + 1, below);
            float* const to = w_.gathered.row(k, y);
            for (int x = lands.x0; x < lands.x1; ++x) {
                const float* const at = line + w_.cell_of[std::size_t(x)];
                to[x] += at[0] + w_.right_of[std::size_t(x)] * (at[1] - at[0]);
            }
        }
    }

    // Gathers the light of one zone; returns its rectangle in the target, outside of which `into` is empty.
    Rect gather_zone(int entry, const Grid& grid, int zone, Planes& into) {
        const Rect &target = grid.target, &window = grid.window;
        const engine::RingSizes& sizes = plan_.sizes;
        const TapKernel& kernel =
            atlas_[plan_.kernel(sizes.ring_of_entry(entry), zone, sizes.is_skirt(entry))];
        w_.window.shape(kPlanes, window.width(), window.height() + kGatherRows);
        // Alpha is coverage where all is opaque; what lies beyond the picture is seldom near.
        planes_ = has_beyond_ || !plan_.opaque ? kPlanes : kAlpha;
        w_.window.clear(planes_);
        Rect lit{window.width(), window.height(), 0, 0};
        for (const Arrival& a : w_.arrivals[std::size_t(entry)]) {
            if (a.zone != zone) continue;
            const std::array<float, kPlanes> values{a.colour.r, a.colour.g, a.colour.b,
                                                    a.covered,  a.colour.a, a.beyond};
            float* at = w_.window.row(0, a.y) + a.x;
            for (int k = 0; k < planes_; ++k, at += w_.window.stride()) *at += values[std::size_t(k)];
            lit = {std::min(lit.x0, a.x), std::min(lit.y0, a.y), std::max(lit.x1, a.x + 1),
                   std::max(lit.y1, a.y + 1)};
        }
        // Position in cells of the target.
        const int shift_x = window.x0 - target.x0, shift_y = window.y0 - target.y0;
        const Rect reached = Rect{lit.x0 + shift_x + kernel.extent.x0, lit.y0 + shift_y + kernel.extent.y0,
                                  lit.x1 + shift_x + kernel.extent.x1, lit.y1 + shift_y + kernel.extent.y1}
                                 .intersected({0, 0, target.width(), target.height()});
        if (reached.empty()) return {};
        shape(into, grid);
        w_.offsets.clear();
        for (const TapKernel::Step& step : kernel.steps)
            w_.offsets.push_back(std::ptrdiff_t(step.dy) * w_.window.width() + step.dx);
        sum_taps(kernel, reached, reached.moved(-shift_x, -shift_y), into);
        return reached;
    }

    // from: the cells of the window where those that are reached lie.
    void sum_taps(const TapKernel& kernel, const Rect& reached, const Rect& from, Planes& into) {
        const int in_x = from.x0, in_y = from.y0;
        const int groups = (reached.width() + kGatherGroup - 1) / kGatherGroup;
        for (int y = 0; y < reached.height(); y += kGatherRows) {
            check_cancelled();
            const engine::StepJob job{w_.offsets.data(),        kernel.weights.data(),
                                      int(kernel.steps.size()), kernel.neutral,
                                      groups * kGatherGroup,    std::min(kGatherRows, reached.height() - y),
                                      w_.window.width(),        into.width()};
            const auto plane = [&](int k) {
                return engine::TapPlane{w_.window.row(k, in_y + y) + in_x,
                                        into.row(k, reached.y0 + y) + reached.x0};
            };
            gather_two(job, plane(kRed), 0, plane(kGreen), 1);
            gather_two(job, plane(kBlue), 2, plane(kCovered), 3);
            if (planes_ == kPlanes) gather_two(job, plane(kAlpha), 3, plane(kBeyond), 3);
        }
    }

    // Each cell gives the turn's light the lens area that it arrives with, or the rest.
    void take(Combined& into) {
        const int n = reached_.width();
        w_.lines.shape(2, n, 1);
        float *areas = w_.lines.plane(0), *scale = w_.lines.plane(1);
        for (int y = reached_.y0; y < reached_.y1; ++y) {
            const auto gathered = [&](int k) { return w_.gathered.row(k, y) + reached_.x0; };
            const auto combined = [&](int k) { return into.planes.row(k, y) + reached_.x0; };
            const float *covered = gathered(kCovered), *area = covered;
            if (has_beyond_) {
                const float* const beyond = gathered(kBeyond);
                for (int x = 0; x < n; ++x) areas[x] = covered[x] + beyond[x];
                area = areas;
            }
            take_area(n, area, covered, combined(Combined::kFree), scale);
            for (int k = 0; k < 3; ++k) add_scaled(n, scale, gathered(k), combined(k));
            add_scaled(n, scale, gathered(plan_.opaque ? kCovered : kAlpha), combined(Combined::kSumAlpha));
        }
        reached_ = {};
    }

    // Gives the tile's pixels the combined result of a coarse group, if cells around them are lit.
    void enlarge(const Grid& grid, const Rect& lit) {
        const float per_cell = 1 / float(1 << grid.level);
        w_.cell_of.clear(), w_.right_of.clear();
        for (int x = 0; x < tile_.width(); ++x) {
            const float at = (float(tile_.x0 + x) + 0.5f) * per_cell - 0.5f - float(grid.target.x0);
            w_.cell_of.push_back(int(at)), w_.right_of.push_back(at - float(int(at)));
        }
        const auto first_from = [&](int cell) {
            return int(std::lower_bound(w_.cell_of.begin(), w_.cell_of.end(), cell) - w_.cell_of.begin());
        };
        const int x0 = first_from(lit.x0 - 1), x1 = first_from(lit.x1);
        if (x0 == x1) return;
        w_.lines.shape(Combined::kCount + 3, std::max(tile_.width(), grid.target.width()), 1);
        for (int y = 0; y < tile_.height(); ++y) {
            const float at_y = (float(tile_.y0 + y) + 0.5f) * per_cell - 0.5f - float(grid.target.y0);
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
    Rect reached_;  // cells of the target that the turn's light reaches
    bool has_beyond_ = false;
    int planes_ = kPlanes;  // that are gathered
};

void copy_tile(const GatherPlan& plan, const Rect& tile, View<Rgba> out) {
    for (int y = tile.y0; y < tile.y1; ++y)
        std::copy_n(plan.strip.samples.colour.row(y) + tile.x0, tile.width(),
                    out.row(plan.first_row + y) + tile.x0);
}

}  // namespace

void gather_tiles(const GatherPlan& plan, const TapAtlas& atlas, View<Rgba> out, const Control& control) {
    Workspaces<Workspace> workspaces;
    const double share = control.share / double(plan.tiles.size());
    parallel_for(int(plan.tiles.size()), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        const GatherPlan::Tile& tile = plan.tiles[std::size_t(i)];
        if (tile.is_sharp) {
            copy_tile(plan, tile.pixels, out);
        } else {
            const auto workspace = workspaces.take();
            TileGather(plan, tile, atlas, *workspace).run(out);
        }
        control.progress.advance(share);
    });
}

}  // namespace petzval::device
