// Kernels ready for stamping, at finely stepped radii, for every level and image cell; made when first asked
// for.
#pragma once

#include "engine/engine.h"
#include "engine/stamp.h"

#include <atomic>
#include <memory>
#include <vector>

namespace petzval::engine {

// Radii are stepped by 1/16 cell. Lenses that vary over the field have one set of kernels for each of 9 x 6
// parts of the picture. Safe to use from many threads: which thread makes a kernel does not change it.
class StampTable {
public:
    // `input`: the whole picture; places are in its pixels.
    StampTable(const Input& input, float largest_radius);
    ~StampTable();
    StampTable(const StampTable&) = delete;
    StampTable& operator=(const StampTable&) = delete;

    // The part of the picture whose kernels the source in cell (x, y) of a level takes: one of the four whose
    // middles are nearest, each as often as bilinear interpolation weighs it, so that nothing steps where
    // parts meet.
    int part_for(int level, int x, int y) const;
    // The kernel for a signed radius in cells of `level`.
    const StampKernel& at(int level, int part, float radius) const;
    // Largest offset of any weight of a kernel of this level, in cells.
    int reach(int level) const { return reach_[std::size_t(level)]; }

private:
    const Input& input_;
    int parts_x_ = 1, parts_y_ = 1, steps_ = 0;  // steps_: kernels on either side of focus
    std::vector<int> reach_;
    mutable std::vector<std::atomic<const StampKernel*>> kernels_;
};

}  // namespace petzval::engine
