#include "device/cpu/gather.h"

#include "base/cancel.h"
#include "base/parallel.h"
#include "base/workspaces.h"
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

constexpr int kPlanes = 6;
using laws::kLeastGathered;
enum PlaneName { kRed, kGreen, kBlue, kCovered, kAlpha, kBeyond };

// Planes side by side in one block of memory that is kept from tile to tile.
class Planes {
public:
    void shape(int count, int width, int height) {
        width_ = (width + kGatherGroup - 1) / kGatherGroup * kGatherGroup + kGatherGroup;
        height_ = height, stride_ = std::size_t(width_) * std::size_t(height_);
        // The last row may be read a group beyond its end.
        const std::size_t needed = std::size_t(count) * stride_ + kGatherGroup;
        if (floats_.size() < needed) floats_.resize(needed);
    }
    int width() const { return width_; }
    int height() const { return height_; }
    std::ptrdiff_t stride() const { return std::ptrdiff_t(stride_); }  // from plane to plane
    float* plane(int i) { return floats_.data() + std::size_t(i) * stride_; }
    float* row(int i, int y) { return plane(i) + std::size_t(y) * std::size_t(width_); }
    void clear(int count) { std::fill_n(floats_.data(), std::size_t(count) * stride_ + kGatherGroup, 0.0f); }

private:
    int width_ = 0, height_ = 0;
    std::size_t stride_ = 0;
    std::vector<float> floats_;
};

// Light of one turn that may reach the tile, at its place in the window.
struct Arrival {
    int x, y;
    int zone;
    Rgba colour;
    float covered, beyond;
};

// Light that arrives with `area` of n cells' lenses takes that of each, or what is still free; scale: what
// its sums are multiplied by for that. Light that covers nothing is seen through whatever part is still free.
void take_area(int n, const float* area, const float* covered, float* free, float* scale) {
    for (int x = 0; x < n; ++x) {
        const bool covers = covered[x] > kLeastGathered;
        const float least = std::min(area[x], free[x]), taken = covers ? least : 0.0f;
        const float share = taken / (covers ? covered[x] : 1.0f);
        scale[x] = covers ? share : free[x];
        free[x] -= taken;
    }
}

void add_scaled(int n, const float* scale, const float* light, float* sum) {
    for (int x = 0; x < n; ++x) sum[x] += scale[x] * light[x];
}

// Result combined so far, per cell: light, and the free part of the lens.
struct Combined {
    Planes planes;  // red, green, blue, alpha, free
    static constexpr int kSumAlpha = 3, kFree = 4, kCount = 5;
    void reset(int width, int height) {
        planes.shape(kCount, width, height);
        planes.clear(kFree);
        std::fill_n(planes.plane(kFree), std::size_t(planes.width()) * std::size_t(planes.height()), 1.0f);
    }
};

struct Workspace {
    std::vector<std::vector<Arrival>> arrivals;  // by turn
    std::vector<std::ptrdiff_t> offsets;
    std::vector<int> zones;  // of a turn's arrivals, each once
    Planes window, gathered, of_zone;
    Combined cells, tile;
    Planes lines;                 // of a row of the tile, for a moment: what is combined, areas, scales
    std::vector<int> cell_of;     // of a tile's columns: the cell before the middle of each
    std::vector<float> right_of;  // and how far beyond its middle that lies, in cells
};

class TileGather {
public:
    TileGather(const GatherPlan& plan, const GatherPlan::Tile& tile, const TapAtlas& atlas,
               Workspace& workspace)
        : plan_(plan), atlas_(atlas), tile_(tile.pixels), w_(workspace) {}

    void run(View<Rgba> out) {
        w_.tile.reset(tile_.width(), tile_.height());
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
        target_ = GatherPlan::cells_of(tile_, level);
        window_ = target_.grown(plan_.reach[std::size_t(level)]);
        find_zones(level);
        find_arrivals(begin, end, level);
        if (std::all_of(w_.arrivals.begin() + begin, w_.arrivals.begin() + end,
                        [](const auto& arrivals) { return arrivals.empty(); }))
            return;
        Combined& into = level == 0 ? w_.tile : w_.cells;
        if (level > 0) into.reset(target_.width(), target_.height());
        Rect lit{target_.width(), target_.height(), 0, 0};
        for (int turn = begin; turn < end; ++turn) {
            if (w_.arrivals[std::size_t(turn)].empty()) continue;
            gather_turn(turn);
            if (reached_.empty()) continue;
            lit = {std::min(lit.x0, reached_.x0), std::min(lit.y0, reached_.y0),
                   std::max(lit.x1, reached_.x1), std::max(lit.y1, reached_.y1)};
            take(into);
        }
        if (level > 0 && !lit.empty()) enlarge(level, lit);
    }

    // Light beyond the picture is spread like the border that it repeats.
    void find_zones(int level) {
        const bool pixels = level == 0;
        const int width = pixels ? plan_.strip.width() : plan_.levels[std::size_t(level - 1)].width();
        const int height = pixels ? plan_.strip.height() : plan_.levels[std::size_t(level - 1)].height();
        const auto middle = [&](int cell, int cells) {
            return std::ldexp(std::clamp(cell, 0, cells - 1) + 0.5, level) - 0.5;
        };
        zone_column_.clear(), zone_row_.clear();
        for (int x = window_.x0; x < window_.x1; ++x)
            zone_column_.push_back(plan_.zones.column_of(middle(x, width)));
        for (int y = window_.y0; y < window_.y1; ++y)
            zone_row_.push_back(plan_.zones.row_of(middle(y, height)) * plan_.zones.columns);
    }

    void find_arrivals(int begin, int end, int level) {
        w_.arrivals.resize(plan_.sizes.turns().size());
        for (int turn = begin; turn < end; ++turn) w_.arrivals[std::size_t(turn)].clear();
        has_beyond_ = false;
        level == 0 ? find_in_picture(begin, end) : find_in_cells(begin, end, level);
    }

    void arrive(int turn, int x, int y, Rgba colour, float covered, float beyond) {
        has_beyond_ = has_beyond_ || beyond > 0;
        x -= window_.x0, y -= window_.y0;
        const int zone = zone_row_[std::size_t(y)] + zone_column_[std::size_t(x)];
        w_.arrivals[std::size_t(turn)].push_back({x, y, zone, colour, covered, beyond});
    }

    // True if the picture continues at an outside position (x, y) as its nearest inside cell; otherwise there
    // is emptiness.
    bool goes_on(int x, int y, int width, int height) const {
        const OpenEdges& open = plan_.strip.window.open_edges;
        return (x >= 0 || open.left) && (x < width || open.right) && (y >= 0 || open.top) &&
               (y < height || open.bottom);
    }

    void find_in_picture(int begin, int end) {
        const int width = plan_.strip.width(), height = plan_.strip.height();
        const float largest_px = plan_.sizes.light_of(0).below_px;
        for (int y = window_.y0; y < window_.y1; ++y)
            for (int x = window_.x0; x < window_.x1; ++x) {
                const int u = std::clamp(x, 0, width - 1), v = std::clamp(y, 0, height - 1);
                const bool outside = u != x || v != y, on = !outside || goes_on(x, y, width, height);
                engine::for_each_sample(plan_.strip, plan_.guessed, u, v,
                                        [&](Rgba colour, float coc_px, float covered, bool hidden) {
                                            if (std::abs(coc_px) > largest_px) return;
                                            plan_.sizes.hand_out(coc_px, hidden, [&](int turn, float share) {
                                                if (turn < begin || turn >= end) return;
                                                arrive(turn, x, y, outside ? Rgba{} : share * colour,
                                                       outside && on ? 0 : share * covered,
                                                       outside && on ? share * covered : 0);
                                            });
                                        });
            }
    }

    void find_in_cells(int begin, int end, int level) {
        const CellLevel& cells = plan_.levels[std::size_t(level - 1)];
        for (int y = window_.y0; y < window_.y1; ++y) {
            const int v = std::clamp(y, 0, cells.height() - 1);
            if (!cells.has_any(v)) continue;
            for (int x = window_.x0; x < window_.x1; ++x) {
                const int u = std::clamp(x, 0, cells.width() - 1);
                const bool outside = u != x || v != y;
                const bool on = outside && goes_on(x, y, cells.width(), cells.height());
                for (const CellLight& light : cells.at(u, v)) {
                    if (light.turn < begin || light.turn >= end) continue;
                    const float all = light.covered + light.beyond;
                    if (!outside)
                        arrive(light.turn, x, y, light.colour, light.covered, light.beyond);
                    else
                        arrive(light.turn, x, y, {}, on ? 0 : all, on ? all : 0);
                }
            }
        }
    }

    // The light of one turn, at every cell of its reach within the target: from each zone by its own kernel.
    void gather_turn(int turn) {
        const std::vector<Arrival>& arrivals = w_.arrivals[std::size_t(turn)];
        const int ring = plan_.sizes.turns()[std::size_t(turn)].ring;
        w_.zones.clear();
        for (const Arrival& a : arrivals)
            if (std::find(w_.zones.begin(), w_.zones.end(), a.zone) == w_.zones.end())
                w_.zones.push_back(a.zone);
        if (w_.zones.size() == 1) {
            reached_ = gather_zone(arrivals, ring, w_.zones.front(), w_.gathered);
            return;
        }
        w_.gathered.shape(kPlanes, target_.width() + kGatherGroup, target_.height() + kGatherRows);
        w_.gathered.clear(kPlanes);
        reached_ = {};
        for (const int zone : w_.zones) {
            const Rect reached = gather_zone(arrivals, ring, zone, w_.of_zone);
            for (int k = 0; k < planes_; ++k)
                for (int y = reached.y0; y < reached.y1; ++y) {
                    const float* from = w_.of_zone.row(k, y);
                    float* to = w_.gathered.row(k, y);
                    for (int x = reached.x0; x < reached.x1; ++x) to[x] += from[x];
                }
            reached_ = reached_.empty() ? reached
                       : reached.empty()
                           ? reached_
                           : Rect{std::min(reached_.x0, reached.x0), std::min(reached_.y0, reached.y0),
                                  std::max(reached_.x1, reached.x1), std::max(reached_.y1, reached.y1)};
        }
    }

    // Gathers the light of one zone; returns its rectangle in the target, outside of which `into` is empty.
    Rect gather_zone(const std::vector<Arrival>& arrivals, int ring, int zone, Planes& into) {
        const TapKernel& kernel = atlas_[plan_.kernel(ring, zone)];
        w_.window.shape(kPlanes, window_.width(), window_.height() + kGatherRows);
        // Alpha is coverage where all is opaque; what lies beyond the picture is seldom near.
        planes_ = has_beyond_ || !plan_.opaque ? kPlanes : kAlpha;
        w_.window.clear(planes_);
        Rect lit{window_.width(), window_.height(), 0, 0};
        for (const Arrival& a : arrivals) {
            if (a.zone != zone) continue;
            const std::array<float, kPlanes> values{a.colour.r, a.colour.g, a.colour.b,
                                                    a.covered,  a.colour.a, a.beyond};
            float* at = w_.window.row(0, a.y) + a.x;
            for (int k = 0; k < planes_; ++k, at += w_.window.stride()) *at += values[std::size_t(k)];
            lit = {std::min(lit.x0, a.x), std::min(lit.y0, a.y), std::max(lit.x1, a.x + 1),
                   std::max(lit.y1, a.y + 1)};
        }
        // Position in cells of the target.
        const int shift_x = window_.x0 - target_.x0, shift_y = window_.y0 - target_.y0;
        const Rect reached = Rect{lit.x0 + shift_x + kernel.extent.x0, lit.y0 + shift_y + kernel.extent.y0,
                                  lit.x1 + shift_x + kernel.extent.x1, lit.y1 + shift_y + kernel.extent.y1}
                                 .intersected({0, 0, target_.width(), target_.height()});
        if (reached.empty()) return {};
        into.shape(kPlanes, target_.width() + kGatherGroup, target_.height() + kGatherRows);
        w_.offsets.clear();
        for (const TapKernel::Step& step : kernel.steps)
            w_.offsets.push_back(std::ptrdiff_t(step.dy) * w_.window.width() + step.dx);
        sum_taps(kernel, reached, into);
        return reached;
    }

    void sum_taps(const TapKernel& kernel, const Rect& reached, Planes& into) {
        const int in_x = reached.x0 + target_.x0 - window_.x0, in_y = reached.y0 + target_.y0 - window_.y0;
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
    void enlarge(int level, const Rect& lit) {
        const float per_cell = 1 / float(1 << level);
        w_.cell_of.clear(), w_.right_of.clear();
        for (int x = 0; x < tile_.width(); ++x) {
            const float at = (float(tile_.x0 + x) + 0.5f) * per_cell - 0.5f - float(target_.x0);
            w_.cell_of.push_back(int(at)), w_.right_of.push_back(at - float(int(at)));
        }
        const auto first_from = [&](int cell) {
            return int(std::lower_bound(w_.cell_of.begin(), w_.cell_of.end(), cell) - w_.cell_of.begin());
        };
        const int x0 = first_from(lit.x0 - 1), x1 = first_from(lit.x1);
        if (x0 == x1) return;
        w_.lines.shape(Combined::kCount + 3, std::max(tile_.width(), target_.width()), 1);
        for (int y = 0; y < tile_.height(); ++y) {
            const float at_y = (float(tile_.y0 + y) + 0.5f) * per_cell - 0.5f - float(target_.y0);
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
    Rect target_, window_;  // cells of the level: where light is wanted, where it may come from
    Rect reached_;          // cells of the target that the turn's light reaches
    bool has_beyond_ = false;
    int planes_ = kPlanes;                     // that are gathered
    std::vector<int> zone_column_, zone_row_;  // of the window's cells: a zone is their sum
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
