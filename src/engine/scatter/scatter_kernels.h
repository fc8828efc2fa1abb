// The kernels that the scatter engine spreads with: at finely stepped radii, for every level and zone.
//
// A kernel with more than a trace of light far outside its level's reach (aberrations spread light wide that
// defocus alone would not) is stamped in two pieces: its core here, its skirt on a coarser level, where it is
// as small. Both fade into each other and add up to the kernel.
#pragma once

#include "device/kernels.h"
#include "device/memory.h"
#include "engine/scatter/plan.h"
#include "engine/waist/engine.h"

#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace petzval::engine {

// Radii are stepped by 1/16 cell, narrow ones more finely, and by 1/4 where aberrations alone spread light
// over many cells. Lenses that vary over the field have one set of kernels for each of 9 x 6 zones of the
// display window. Safe to use from many threads: which thread makes a kernel does not change it.
class ScatterKernels final : public device::KernelSource, public device::Memory::Thing {
public:
    ScatterKernels(const LensOnPicture& lens, const LevelRule& rule);
    // Name of the set of one lens and quality.
    static std::string name_for(const LevelRule& rule);

    // The zones whose kernels the source in cell (x, y) of a level takes, in a picture with this frame, so
    // that nothing steps where zones meet: one of the four whose middles are nearest, each as often as
    // bilinear interpolation weighs it. Among nearly sharp sources that choice would be seen: where
    // aberrations make the kernels of those wide, they take their share of each; where not, the nearest.
    struct ZoneShare {
        int zone = 0;
        float share = 0;  // 0: this zone is not used
    };
    std::array<ZoneShare, 4> zones_for(const Rect& frame, int level, int x, int y, float radius) const;
    bool has_zones() const { return zones_x_ * zones_y_ > 1; }
    // The kernel for a signed radius in cells of `level`. skirt_of 0: the whole kernel, or its core if it has
    // a skirt; n: the skirt of the kernel n levels finer.
    device::KernelAsk ask(int level, int zone, float radius, int skirt_of, bool by_sector) const {
        level = std::min(level, levels_ - 1);
        const int step = step_of(level, radius);
        return {level, zone, radius < 0 ? ~step : step, skirt_of, by_sector};
    }
    // Number of a kernel among all possible kernels, in their order.
    std::size_t number_of(const device::KernelAsk& ask) const {
        std::size_t number = std::size_t(ask.level * zones_x_ * zones_y_ + ask.zone);
        number = number * std::size_t(2 * steps_) + std::size_t(ask.step + steps_);
        return (number * std::size_t(pieces()) + std::size_t(ask.piece)) * 2 + (ask.by_sector ? 1 : 0);
    }
    device::KernelAsk ask_of(std::size_t number) const;
    std::size_t asks() const {
        return std::size_t(levels_ * zones_x_ * zones_y_ * 2 * steps_ * pieces() * 2);
    }

    std::vector<Made> make(std::span<const device::KernelAsk> asks) const override;

    // Number of levels by which the skirt of this kernel is stamped coarser; 0: it has no skirt.
    int skirt_levels(int level, float radius) const;
    static constexpr int kMostSkirtLevels = 3;
    // The coarsest level that sources of levels 0…level are stamped on, skirts included.
    int coarsest_for(int level) const;
    // Largest offset of any weight of a kernel of this level, in cells.
    int reach(int level) const { return reach_[std::min(std::size_t(level), reach_.size() - 1)]; }
    // The same for the kernels of one radius.
    int reach(int level, float radius) const;

    std::size_t bytes() const override;

private:
    int pieces() const { return has_skirts_ ? 1 + kMostSkirtLevels : 1; }
    int step_of(int level, float radius) const;
    // Place in the set: level, zone and signed step (steps in front of focus are ~n).
    struct Place {
        int level = 0, zone = 0, step = 0;
        friend auto operator<=>(const Place&, const Place&) = default;  // NOLINT(modernize-use-nullptr)
    };
    float radius_of(const Place& place) const;  // signed, in cells
    kernel::PointSpread whole(const Place& place) const;
    kernel::PointSpread core(const kernel::PointSpread& whole, const Place& place) const;
    kernel::PointSpread skirt(const kernel::PointSpread& whole, const Place& place, int skirt_of) const;
    Rgba light_of_core(const Place& place) const;
    int find_skirt_levels(int level, int step) const;
    int skirt_levels_for(float farthest) const;  // for light that reaches this many cells

    LensOnPicture lens_;                                  // on a picture that begins with the display window
    int levels_, zones_x_ = 1, zones_y_ = 1, steps_ = 0;  // steps_: kernels on either side of focus
    int inner_sectors_, outer_sectors_;
    float core_begin_, core_end_;  // cells from the middle where cores fade out
    bool has_skirts_ = false;
    std::vector<int> most_skirt_levels_;  // per level: the largest of all its kernels
    std::vector<int> reach_;
    std::vector<bool> blurred_;           // per level: its kernels are wide also at radius 0
    std::vector<short> reach_of_radius_;  // per level and step
    mutable std::vector<std::atomic<short>> skirt_levels_;  // per level and signed step; -1: not known yet
    mutable std::mutex mutex_;                              // guards light_of_core_
    mutable std::map<Place, Rgba> light_of_core_;
};

}  // namespace petzval::engine
