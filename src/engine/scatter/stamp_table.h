// Kernels ready for stamping, at finely stepped radii, for every level and image cell; made when first asked
// for.
//
// A kernel with more than a trace of light far outside its level's reach (aberrations spread light wide that
// defocus alone would not) is stamped in two pieces: its core here, its skirt on a coarser level, where it is
// as small. Both fade into each other and add up to the kernel.
#pragma once

#include "device/cpu/stamp.h"
#include "engine/scatter/sources.h"
#include "engine/waist/engine.h"

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace petzval::engine {

// Radii are stepped by 1/16 cell, narrow ones more finely. Lenses that vary over the field have one set of
// kernels for each of 9 x 6 parts of the picture. Safe to use from many threads: which thread makes a kernel
// does not change it.
class StampTable {
public:
    // Of a picture of this size; places are in its pixels.
    StampTable(const LensOnPicture& lens, int width, int height, const LevelRule& rule);
    ~StampTable();
    StampTable(const StampTable&) = delete;
    StampTable& operator=(const StampTable&) = delete;

    // The parts of the picture whose kernels the source in cell (x, y) of a level takes, so that nothing
    // steps where parts meet: one of the four whose middles are nearest, each as often as bilinear
    // interpolation weighs it. Among nearly sharp sources that choice would be seen: where aberrations make
    // the kernels of those wide, they take their share of each; where not, the nearest.
    struct PartShare {
        int part = 0;
        float share = 0;  // 0: not taken
    };
    std::array<PartShare, 4> parts_for(int level, int x, int y, float radius) const;
    // The kernel for a signed radius in cells of `level`. skirt_of 0: the whole kernel, or its core if it has
    // a skirt; n: the skirt of the kernel n levels finer.
    std::span<const StampKernel, 1> at(int level, int part, float radius, int skirt_of) const;
    // What comes through each of the rule's cells of the pupil, times their number.
    std::span<const StampKernel> by_pupil_cell(int level, int part, float radius, int skirt_of) const;
    int pupil_cells() const { return inner_cells_ + outer_cells_; }
    // How many levels coarser the skirt of this kernel is stamped; 0: it has none.
    int skirt_levels(int level, float radius) const;
    static constexpr int kMostSkirtLevels = 3;
    // The coarsest level that sources of levels 0…level are stamped on, skirts included.
    int coarsest_for(int level) const;
    // Largest offset of any weight of a kernel of this level, in cells.
    int reach(int level) const { return reach_[std::min(std::size_t(level), reach_.size() - 1)]; }
    // The same, of kernels for this radius.
    int reach(int level, float radius) const;

private:
    using Cells = std::vector<StampKernel>;
    struct Kernel {
        StampKernel whole;
        mutable std::atomic<const Cells*> cells = nullptr;
        explicit Kernel(StampKernel kernel) : whole(std::move(kernel)) {}
        ~Kernel() { delete cells.load(); }
    };
    const Kernel& kernel_at(int level, int part, float radius, int skirt_of) const;
    std::unique_ptr<const Cells> cells_of(const kernel::PointSpread& all, bool turned) const;
    int step_of(float radius) const;
    std::size_t slot_of(int level, int part, float radius, int skirt_of) const;
    kernel::PointSpread whole(int level, int part, float radius) const;
    kernel::PointSpread piece(int level, int part, float radius, int skirt_of) const;
    kernel::PointSpread skirt(kernel::PointSpread cut_out, int level, int part, float radius,
                              int skirt_of) const;
    int find_skirt_levels(int level, float radius) const;
    int skirt_levels_for(float farthest) const;  // of light that reaches so many cells
    float stepped(float radius) const;           // the radius that stands for it

    LensOnPicture lens_;
    int width_, height_;
    int levels_, parts_x_ = 1, parts_y_ = 1, steps_ = 0;  // steps_: kernels on either side of focus
    int inner_cells_, outer_cells_;
    float core_begin_, core_end_;  // cells from the middle where cores fade out
    bool has_skirts_ = false;
    std::vector<int> most_skirt_levels_;  // of any kernel of a level
    std::vector<int> reach_;
    std::vector<short> reach_of_radius_;  // per level and step
    mutable std::vector<std::atomic<const Kernel*>> kernels_;
    mutable std::vector<std::atomic<short>> skirt_levels_;  // per level and radius; -1: not known yet
};

}  // namespace petzval::engine
