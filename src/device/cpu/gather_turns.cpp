#include "device/cpu/gather_turns.h"

#include "base/cancel.h"
#include "device/cpu/gather_taps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace petzval::device::gathering {
namespace {

using engine::CellLevel;
using engine::CellLight;
using engine::GatherPlan;
using engine::kGatherGroup;
using engine::kGatherRows;
using engine::OpenEdges;

class TurnGather {
public:
    TurnGather(const GatherPlan& plan, const TapAtlas& atlas, Workspace& workspace)
        : plan_(plan), atlas_(atlas), w_(workspace) {
        w_.arrivals.resize(std::size_t(plan_.sizes.entries()));
        w_.grids.resize(std::size_t(plan_.sizes.levels()));
    }

    Rect combine(const TurnGroup& group, const Rect& target, Combined& into) {
        find_grid(group.level, target);
        const Grid& grid = w_.grids[std::size_t(group.level)];
        Rect lit;
        if (!find_arrivals(group.begin, group.end, grid)) return lit;
        if (group.level > 0) into.reset(target.width(), target.height());
        Rect seam;
        for (int turn = group.begin; turn < group.end; ++turn) {
            is_seam_ = plan_.sizes.turns()[std::size_t(turn)].is_seam;
            if (is_seam_ && (lit.empty() || !has_arrivals(turn + 1, group.end))) continue;
            gather_turn(turn, grid);
            if (reached_.empty()) continue;
            if (is_seam_)
                seam = reached_;
            else
                lit = with(lit, reached_);
            take(into);
        }
        for (int y = seam.y0; y < seam.y1; ++y) {
            const float* const taken = w_.seam.row(0, y);
            float* const free = into.planes.row(Combined::kFree, y);
            for (int x = seam.x0; x < seam.x1; ++x) free[x] += taken[x];
        }
        return lit;
    }

private:
    // The cells of a level and, for skirts, those of a coarser one below them. Light beyond the picture is
    // spread like the border that it repeats.
    void find_grid(int level, const Rect& target) {
        Grid& grid = w_.grids[std::size_t(level)];
        grid.level = level, grid.target = target;
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
            find_grid(level, engine::cells_of(grid.target, level - grid.level, GatherPlan::kTentBorder));
            find_in_cells(first_skirt, last_skirt, w_.grids[std::size_t(level)]);
        }
        return has_arrivals(begin, end);
    }

    // True if turns begin…end-1, or their skirts, have light.
    bool has_arrivals(int begin, int end) const {
        const auto any = [&](int first, int last) {
            return std::any_of(w_.arrivals.begin() + first, w_.arrivals.begin() + last,
                               [](const auto& arrivals) { return !arrivals.empty(); });
        };
        return any(begin, end) || any(plan_.sizes.skirt_entry(begin), plan_.sizes.skirt_entry(end));
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
                engine::for_each_sample(plan_.strip, *plan_.surfaces, plan_.sizes.farthest_px(), u, v,
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
        const std::vector<Arrival>& arrivals = w_.arrivals[std::size_t(entry)];
        Rect lit{window.width(), window.height(), 0, 0};
        for (const Arrival& a : arrivals)
            if (a.zone == zone)
                lit = {std::min(lit.x0, a.x), std::min(lit.y0, a.y), std::max(lit.x1, a.x + 1),
                       std::max(lit.y1, a.y + 1)};
        // Position in cells of the target.
        const int shift_x = window.x0 - target.x0, shift_y = window.y0 - target.y0;
        const Rect reached = Rect{lit.x0 + shift_x + kernel.extent.x0, lit.y0 + shift_y + kernel.extent.y0,
                                  lit.x1 + shift_x + kernel.extent.x1, lit.y1 + shift_y + kernel.extent.y1}
                                 .intersected({0, 0, target.width(), target.height()});
        if (reached.empty()) return {};
        // Alpha equals coverage in an opaque picture and needs no plane; `beyond` needs one only near the
        // border.
        planes_ = has_beyond_ || !plan_.opaque ? kPlanes : kAlpha;
        w_.window.shape(kPlanes, window.width(), window.height() + kGatherRows);
        w_.window.clear_rows(planes_, lit.y0, lit.y1);
        for (const Arrival& a : arrivals) {
            if (a.zone != zone) continue;
            const std::array<float, kPlanes> values{a.colour.r, a.colour.g, a.colour.b,
                                                    a.covered,  a.colour.a, a.beyond};
            float* at = w_.window.row(0, a.y) + a.x;
            for (int k = 0; k < planes_; ++k, at += w_.window.stride()) *at += values[std::size_t(k)];
        }
        shape(into, grid);
        for (int x = 0; x < reached.width(); x += kGatherGroup) {
            const Rect column{reached.x0 + x, reached.y0, reached.x0 + x + kGatherGroup, reached.y1};
            sum_taps(steps_that_read(kernel, lit, column.x0 - shift_x), kernel.neutral, column,
                     {column.x0 - shift_x, column.y0 - shift_y}, lit, into);
        }
        return reached;
    }

    // The steps of a kernel, or some of them, in its order.
    struct Steps {
        const TapKernel::Step* steps;
        const float* weights;
        int count;
    };
    // The steps that read lit columns of the window for some of the kGatherGroup columns of output from x on.
    // The others would add nothing.
    Steps steps_that_read(const TapKernel& kernel, const Rect& lit, int x) {
        const int first = lit.x0 - (x + kGatherGroup - 1), last = lit.x1 - 1 - x;
        if (first <= 1 - kernel.extent.x1 && last >= -kernel.extent.x0)
            return {kernel.steps.data(), kernel.weights.data(), int(kernel.steps.size())};
        const std::size_t weights = std::size_t(kGatherRows) * (kernel.neutral ? 1 : 4);
        w_.steps.clear();
        w_.weights.clear();
        for (std::size_t i = 0; i < kernel.steps.size(); ++i) {
            if (kernel.steps[i].dx < first || kernel.steps[i].dx > last) continue;
            w_.steps.push_back(kernel.steps[i]);
            const float* const from = kernel.weights.data() + i * weights;
            w_.weights.insert(w_.weights.end(), from, from + weights);
        }
        return {w_.steps.data(), w_.weights.data(), int(w_.steps.size())};
    }

    struct Cell {
        int x, y;
    };
    // Sums one column of cells, kGatherGroup wide. from: the cell of the window where the first lies.
    void sum_taps(const Steps& all, bool neutral, const Rect& column, const Cell& from, const Rect& lit,
                  Planes& into) {
        w_.offsets.clear();
        for (int i = 0; i < all.count; ++i)
            w_.offsets.push_back(std::ptrdiff_t(all.steps[i].dy) * w_.window.width() + all.steps[i].dx);
        const int per_step = kGatherRows * (neutral ? 1 : 4);
        for (int y = 0; y < column.height(); y += kGatherRows) {
            check_cancelled();
            const auto step_from = [&](int row) {
                return int(
                    std::partition_point(all.steps, all.steps + all.count,
                                         [&](const auto& step) { return from.y + y + step.dy < row; }) -
                    all.steps);
            };
            // Rows that are not lit add nothing, and are not cleared.
            const int first = step_from(lit.y0), end = step_from(lit.y1);
            const engine::StepJob job{w_.offsets.data() + first,
                                      all.weights + std::ptrdiff_t(first) * per_step,
                                      end - first,
                                      neutral,
                                      kGatherGroup,
                                      std::min(kGatherRows, column.height() - y),
                                      w_.window.width(),
                                      into.width()};
            const auto plane = [&](int k) {
                return engine::TapPlane{w_.window.row(k, from.y + y) + from.x,
                                        into.row(k, column.y0 + y) + column.x0};
            };
            if (is_seam_) {
                gather_two(job, plane(planes_ == kPlanes ? kBeyond : kBlue), 3, plane(kCovered), 3);
                continue;
            }
            gather_two(job, plane(kRed), 0, plane(kGreen), 1);
            gather_two(job, plane(kBlue), 2, plane(kCovered), 3);
            if (planes_ == kPlanes) gather_two(job, plane(kAlpha), 3, plane(kBeyond), 3);
        }
    }

    // Each cell gives the turn's light the lens area that it arrives with, or the rest. A seam's is noted.
    void take(Combined& into) {
        const int n = reached_.width();
        w_.lines.shape(2, n, 1);
        if (is_seam_) w_.seam.shape(1, into.planes.width(), into.planes.height());
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
            if (is_seam_) {
                take_seam(n, area, combined(Combined::kFree), w_.seam.row(0, y) + reached_.x0);
                continue;
            }
            take_area(n, area, covered, combined(Combined::kFree), scale);
            for (int k = 0; k < 3; ++k) add_scaled(n, scale, gathered(k), combined(k));
            add_scaled(n, scale, gathered(plan_.opaque ? kCovered : kAlpha), combined(Combined::kSumAlpha));
        }
        reached_ = {};
    }

    const GatherPlan& plan_;
    const TapAtlas& atlas_;
    Workspace& w_;
    Rect reached_;  // cells of the target that the turn's light reaches
    bool has_beyond_ = false;
    bool is_seam_ = false;  // of the turn that is gathered: area alone
    int planes_ = kPlanes;  // that are gathered
};

}  // namespace

std::vector<TurnGroup> turn_groups(const engine::RingSizes& sizes) {
    std::vector<TurnGroup> groups;
    const int turns = int(sizes.turns().size());
    for (int turn = 0; turn < turns; ++turn) {
        const int level = sizes.level_of_turn(turn);
        if (groups.empty() || groups.back().level != level) groups.push_back({turn, turn, level});
        groups.back().end = turn + 1;
    }
    return groups;
}

Rect combine_turns(const GatherPlan& plan, const TapAtlas& atlas, const TurnGroup& group, const Rect& target,
                   Workspace& workspace, Combined& into) {
    return TurnGather(plan, atlas, workspace).combine(group, target, into);
}

}  // namespace petzval::device::gathering
