// The inner loops of spreading, for the instructions of this machine: kernels added to accumulators, layers
// enlarged. Chosen at run time; stamp_simd.cpp is compiled once per instruction set, scalar
// included.
#pragma once

#include "petzval/image.h"

#include "engine/scatter/plan.h"
#include "kernel/model/lens_model.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace petzval::engine {

// A kernel laid out for stamping: rows of RGBA weights, padded with zeros to whole groups of kGroup pixels.
// Rows and columns without light at its edges are left out.
class StampKernel {
public:
    static constexpr int kGroup = 4;
    StampKernel() = default;
    explicit StampKernel(const kernel::PointSpread& spread);

    Rect extent() const { return extent_; }  // offsets that hold weights
    int groups() const { return groups_; }   // per row
    // First and past-the-last group of a row (counted from the top) that holds any weight.
    int first_group(int row) const { return spans_[std::ptrdiff_t(row) * 2]; }
    int last_group(int row) const { return spans_[std::ptrdiff_t(row) * 2 + 1]; }
    const float* row(int row) const { return &weights_.row(row)->r; }
    std::size_t bytes() const { return weights_.bytes(); }

private:
    Rect extent_;
    int groups_ = 0;
    Picture weights_;
    std::unique_ptr<short[]> spans_;
};

struct Rows {
    int begin = 0, end = 0;
    bool empty() const { return begin >= end; }
    Rows with(Rows other) const {
        if (empty() || other.empty()) return empty() ? other : *this;
        return {std::min(begin, other.begin), std::max(end, other.end)};
    }
};

// Accumulated light over an area of cells, with room on either side of every row for whole groups to spill
// into.
class Accumulator {
public:
    static constexpr int kSpill = StampKernel::kGroup;
    // Zeroes the area. Keeps its memory when it has been larger.
    void reset(const Rect& area);
    const Rect& area() const { return area_; }
    // Rows that may hold light.
    Rows touched() const { return touched_; }
    void touch(Rows rows) { touched_ = touched_.with(rows); }
    Rgba* row(int y) { return pixels_.row(y - area_.y0) + kSpill; }
    const Rgba* row(int y) const { return pixels_.row(y - area_.y0) + kSpill; }

private:
    Rect area_;
    Rows touched_;
    Picture pixels_;
};

// light x kernels[i] into[i], their centre at (x, y), each weight times max(0, 1 + tilt . offset); clipped to
// the accumulators. Requires: as many accumulators as kernels.
void stamp(std::span<const StampKernel> kernels, int x, int y, Rgba light, float tilt_x, float tilt_y,
           std::span<Accumulator> into);

// Dimming of a kernel's row: shares of 0…1, each four times (once per channel), for whole groups from the
// kernel's left on; `between` of the way from `first` to `second`. Null: the row is invisible.
struct DimmedRow {
    const float *first = nullptr, *second = nullptr;
    float between = 0;
};
// light x kernel x shares; `rows` are those of the kernel. Shares are 16-float aligned.
void stamp_dimmed(const StampKernel& kernel, int x, int y, Rgba light, const DimmedRow* rows,
                  Accumulator& into);

// sums[i] += weights[i] x light x shares[i]. Requires: as many shares and sums as weights.
void add_shares(std::span<const Rgba> weights, Rgba light, std::span<const float> shares, Rgba* sums);

// Adds `coarse`, whose cells are 2^level pixels wide, to `fine`: Catmull-Rom.
// Requires: coarse covers the cells of fine's area and two more on every side. `scratch` may hold anything.
void add_enlarged(const Accumulator& coarse, int level, Accumulator& fine, std::vector<float>& scratch);

// "AVX3", "AVX2", "SSE4", "SCALAR", …: what the loops above run on here.
const char* instruction_set();

}  // namespace petzval::engine
