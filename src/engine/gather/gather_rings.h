// The few sizes of kernel that a gather works with, and the kernels of the lens at these sizes.
//
// A source of any radius is handed to the two rings around it,
//     share of the outer = (c^2 - inner^2) / (outer^2 - inner^2),
// so that the second moment of the light equals that of the source's own disc.
#pragma once

#include "device/kernels.h"
#include "engine/waist/engine.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace petzval::engine {

struct RingRule {
    float ratio = 1.15f;  // of one radius to the next
    // Rings up to this radius, and one more, are gathered at full resolution; those beyond, at the finest of
    // 1/2, 1/4, … where they, or all but the last, are not wider than largest_cells.
    float full_res_px = 6, largest_cells = 12;
    // Aberrations spread light wider than its ring's radius. A kernel that does not end within core_end() is
    // gathered in two pieces: its core on the ring's level, its skirt on a coarser one where it is as small.
    float full_res_core = 6;  // cells up to which a core is whole at full resolution; elsewhere largest_cells
    float core_begin(int level) const { return level == 0 ? full_res_core : largest_cells; }
    float core_end(int level) const { return 1.5f * core_begin(level); }
};
RingRule ring_rule(Quality quality);

// Radii of the rings: 0, and steps of `ratio` down from the largest radius on either side, so that infinity
// has its own ring exactly. Where the level changes, a radius has a ring on either level, so that no source
// lies between two levels. Numbered from the nearest (most negative) to the farthest.
class RingSizes {
public:
    // has_seams: levels behind focus have seams (Turn).
    RingSizes(float nearest_px, float farthest_px, const RingRule& rule, const LensOnPicture& lens,
              bool has_seams);

    const RingRule& rule() const { return rule_; }
    int count() const { return int(radii_px_.size()); }
    float radius_px(int ring) const { return radii_px_[std::size_t(ring)]; }
    float farthest_px() const { return radii_px_.back(); }
    int level(int ring) const { return levels_[std::size_t(ring)]; }  // cells are 2^level pixels wide
    int skirt_level(int ring) const { return skirt_levels_[std::size_t(ring)]; }  // 0: all is core
    int levels() const;                                                           // skirts included

    // Light of other sizes, in front of focus or behind it, is not a part of a level.
    struct Sizes {
        float above_px = 0, below_px = 0;
        bool contains(float coc_px) const {
            return std::abs(coc_px) > above_px && std::abs(coc_px) < below_px;
        }
    };
    Sizes light_of(int level) const;

    struct Mix {
        int inner = 0, outer = 0;
        float outer_share = 0;
    };
    Mix mix(float coc_px) const {
        const float step = (coc_px - radii_px_.front()) * steps_per_px_;
        std::size_t i = starts_[std::size_t(std::clamp(step, 0.0f, float(starts_.size() - 1)))];
        while (i < radii_px_.size() && radii_px_[i] < coc_px) ++i;
        const Interval& between = intervals_[i];
        return {between.inner, between.outer,
                std::clamp((coc_px * coc_px - between.low) * between.scale, 0.0f, 1.0f)};
    }

    // The order in which rings are gathered: from the nearest to the farthest; of one ring first what the
    // pinhole sees. What other things of its own pixel hide from it waits until the ring beyond has had its
    // turn, if that is of the same level: what is in front may be shared between the same two rings.
    //
    // Behind focus, a surface that continues past a change of level is in two groups of turns. The farther
    // group would show what the surface's nearer part hides. So after its first rings it has a seam: the
    // coverage P of the nearer group's last rings, by the kernel of `ring`. Where the first rings took an
    // area T of the lens, a seam takes P * min(1, T / (1 - P)): all of P if the surface fills the lens, none
    // of another surface. A seam adds no light. After the last ring of its group, farther turns may fill the
    // area that the seam took.
    struct Turn {
        int ring;
        bool hidden;
        bool is_seam = false;
    };
    std::span<const Turn> turns() const { return turns_; }
    int level_of_turn(int turn) const { return level(turns_[std::size_t(turn)].ring); }

    // Cells store light by entry: one entry for each turn, followed by one for each turn whose skirt is
    // gathered.
    int entries() const { return 2 * int(turns_.size()); }
    int skirt_entry(int turn) const { return turn + int(turns_.size()); }
    bool is_skirt(int entry) const { return entry >= int(turns_.size()); }
    int ring_of_entry(int entry) const { return turns_[std::size_t(entry) % turns_.size()].ring; }
    // The entry of a turn's light on a level; -1: the level has none of it.
    int entry_at(int turn, int level) const {
        if (level_of_turn(turn) == level) return turn;
        const int skirt = skirt_level(turns_[std::size_t(turn)].ring);
        return skirt > 0 && skirt == level ? skirt_entry(turn) : -1;
    }

    // Calls emit(turn, share) for the rings of a source.
    template <typename Emit>
    void hand_out(float coc_px, bool hidden, const Emit& emit) const {
        const Mix to = mix(coc_px);
        const auto give = [&](int ring, float share) {
            if (share > 0) emit(turn_of_[std::size_t(2 * ring + (hidden ? 1 : 0))], share);
        };
        give(to.inner, 1 - to.outer_share);
        give(to.outer, to.outer_share);
    }
    // Calls emit(turn, share) for the seam that a source is a part of, if any; never of level 0.
    template <typename Emit>
    void hand_out_to_seam(float coc_px, const Emit& emit) const {
        if (!has_seams_) return;
        const Mix to = mix(coc_px);
        const auto give = [&](int ring, float share) {
            if (const int seam = seam_of_[std::size_t(ring)]; seam >= 0 && share > 0) emit(seam, share);
        };
        give(to.inner, 1 - to.outer_share);
        give(to.outer, to.outer_share);
    }

private:
    void put_in_order();
    // True if a coarser level begins with this ring, behind focus, and has a seam.
    bool has_seam(int ring) const {
        return has_seams_ && ring > 0 && radius_px(ring) > 0 && level(ring) > level(ring - 1);
    }
    // Calls visit(ring) for the rings whose light is in the seam of a level that begins with `first`.
    template <typename Visit>
    void for_each_in_seam(int first, const Visit& visit) const {
        for (int ring = first - 1; ring >= std::max(0, first - kSeamRings); --ring)
            if (radius_px(ring) > 0 && level(ring) == level(first - 1)) visit(ring);
    }

    // Rings on either side of a change of level that a seam compares. A disc of 6 px spans three radii 1.15
    // apart on a floor that goes from one to the next within 4 px.
    static constexpr int kSeamRings = 3;

    // Two radii between which light is shared, with the smaller one's c^2 and 1 / (outer^2 - inner^2). A disc
    // within its pixel is not blurred: no c^2 counts as less than that of such a disc.
    struct Interval {
        int inner, outer;
        float low, scale;
    };
    std::vector<float> radii_px_;
    RingRule rule_;
    bool has_seams_;
    std::vector<int> levels_, skirt_levels_;
    std::vector<Turn> turns_;
    std::vector<int> turn_of_;         // visible and hidden, ring by ring
    std::vector<int> seam_of_;         // the seam that a ring's light is part of; -1: of none
    std::vector<Interval> intervals_;  // [i]: up to radii_px_[i]; the last: beyond all
    // A lookup table, because millions of pixels ask: for each of many equal steps from the first radius to
    // the last, the first radius that is not below the start of the step.
    std::vector<std::uint16_t> starts_;
    float steps_per_px_ = 0;
};

// Parts of the display window whose lights share kernels: 9 x 6 where the lens differs over it, else one.
struct Zones {
    int columns = 1, rows = 1;
    Rect frame;  // the display window, in pixels of a picture
    int count() const { return columns * rows; }
    // Column of the grid at a place in the picture.
    int column_of(double x) const { return at(x - frame.x0, frame.width(), columns); }
    int row_of(double y) const { return at(y - frame.y0, frame.height(), rows); }

private:
    static int at(double pixel, int pixels, int zones) {
        return std::clamp(int((pixel + 0.5) / pixels * zones), 0, zones - 1);
    }
};

// Kernels of rings for all zones. An ask's step is
// the ring's radius, so that rings of one radius share kernels whatever rings are beside them.
class RingKernels final : public device::KernelSource {
public:
    RingKernels(const LensOnPicture& lens, const RingSizes& sizes);

    // Zones of a picture with this display window.
    Zones zones(const Rect& frame) const { return {zones_.columns, zones_.rows, frame}; }
    device::KernelAsk ask(int ring, int zone, bool skirt) const;
    std::vector<Made> make(std::span<const device::KernelAsk> asks) const override;
    // Largest reach of the kernels of a level, in cells.
    int reach(int level) const { return reach_[std::size_t(level)]; }

private:
    kernel::PointSpread whole(int level, int zone, float radius_px) const;
    kernel::PointSpread core(int level, int zone, float radius_px) const;

    const LensOnPicture lens_;  // of a picture that begins with the display window
    RingSizes sizes_;
    Zones zones_;  // in that picture
    std::vector<int> reach_;
};

}  // namespace petzval::engine
