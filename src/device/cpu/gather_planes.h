// The memory of a tile that is gathered: planes of numbers, light that may reach it, what was combined.
#pragma once

#include "petzval/image.h"

#include "device/cpu/gather_taps.h"
#include "device/cpu/tap_kernel.h"
#include "laws/compositing.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace petzval::device::gathering {

constexpr int kPlanes = 6;
enum PlaneName { kRed, kGreen, kBlue, kCovered, kAlpha, kBeyond };

// Planes side by side in one block of memory that is kept from tile to tile.
class Planes {
public:
    void shape(int count, int width, int height) {
        width_ = (width + engine::kGatherGroup - 1) / engine::kGatherGroup * engine::kGatherGroup +
                 engine::kGatherGroup;
        height_ = height, stride_ = std::size_t(width_) * std::size_t(height_);
        // The last row may be read a group beyond its end.
        const std::size_t needed = std::size_t(count) * stride_ + engine::kGatherGroup;
        if (floats_.size() < needed) floats_.resize(needed);
    }
    int width() const { return width_; }
    int height() const { return height_; }
    std::ptrdiff_t stride() const { return std::ptrdiff_t(stride_); }  // from plane to plane
    float* plane(int i) { return floats_.data() + std::size_t(i) * stride_; }
    float* row(int i, int y) { return plane(i) + std::size_t(y) * std::size_t(width_); }
    const float* row(int i, int y) const {
        return floats_.data() + std::size_t(i) * stride_ + std::size_t(y) * std::size_t(width_);
    }
    void clear_rows(int count, int y0, int y1) {
        for (int i = 0; i < count; ++i)
            std::fill_n(row(i, y0), std::size_t(y1 - y0) * std::size_t(width_), 0.0f);
    }
    void clear(int count) {
        std::fill_n(floats_.data(), std::size_t(count) * stride_ + engine::kGatherGroup, 0.0f);
    }

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

// Gives light that arrives at n cells, with a lens area in each, that area or the area that is still free.
// scale: the factor on the sums of this light. Light without coverage is seen through the whole free area.
inline void take_area(int n, const float* area, const float* covered, float* free, float* scale) {
    for (int x = 0; x < n; ++x) {
        const bool covers = covered[x] > laws::kLeastGathered;
        const float least = std::min(area[x], free[x]), taken = covers ? least : 0.0f;
        const float share = taken / (covers ? covered[x] : 1.0f);
        scale[x] = covers ? share : free[x];
        free[x] -= taken;
    }
}

// Gives a seam (RingSizes::Turn) its part of the free area; taken: how much that is.
inline void take_seam(int n, const float* area, float* free, float* taken) {
    for (int x = 0; x < n; ++x) {
        const float covered = std::min(area[x], 1.0f);
        const float rest = std::max(1 - covered, laws::kLeastGathered);
        taken[x] = std::min(covered * std::min((1 - free[x]) / rest, 1.0f), free[x]);
        free[x] -= taken[x];
    }
}

inline void add_scaled(int n, const float* scale, const float* light, float* sum) {
    for (int x = 0; x < n; ++x) sum[x] += scale[x] * light[x];
}

// The light combined so far, per cell, and the part of the lens that is still free.
struct Combined {
    Planes planes;  // red, green, blue, alpha, free
    static constexpr int kSumAlpha = 3, kFree = 4, kCount = 5;
    void reset(int width, int height) {
        planes.shape(kCount, width, height);
        planes.clear(kFree);
        std::fill_n(planes.plane(kFree), std::size_t(planes.width()) * std::size_t(planes.height()), 1.0f);
    }
};

// The cells of one level that a tile needs: where light is wanted, where it may come from, and their zones.
struct Grid {
    int level = 0;
    Rect target, window;
    std::vector<int> zone_column, zone_row;  // of the window's cells: a zone is their sum
};

struct Workspace {
    std::vector<Grid> grids;                     // by level
    std::vector<std::vector<Arrival>> arrivals;  // by entry (RingSizes)
    std::vector<std::ptrdiff_t> offsets;
    std::vector<TapKernel::Step> steps;  // of a kernel those that read lit cells, with their weights
    std::vector<float> weights;
    std::vector<int> zones;  // of a turn's arrivals, each once
    Planes window, gathered, of_zone, skirt;
    Planes seam;  // the lens area that a group's seam took
    Combined cells, tile;
    Planes lines;                 // of a row of the tile, for a moment: what is combined, areas, scales
    std::vector<int> cell_of;     // of a tile's columns: the cell before the middle of each
    std::vector<float> right_of;  // and how far beyond its middle that lies, in cells
};

}  // namespace petzval::device::gathering
