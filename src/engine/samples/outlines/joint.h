// One outline through two ends.
#pragma once

#include "engine/samples/outlines/outline_end.h"

#include <cmath>
#include <optional>

namespace petzval::engine {

struct Joint {
    int other = -1;  // number of the other end; -1: none
    Arc arc{};
    float length_px = 0;
    bool sure = false;  // true if both ends know their direction

    // Its length, and more of it the more it turns (Kellman and Shipley: the less, the more relatable).
    float effort() const { return length_px * (1 + std::abs(arc.curvature) * length_px); }
    bool better_than(const Joint& o) const {
        return o.other < 0 || (sure != o.sure ? sure : effort() < o.effort());
    }
};

// The arc through the visible points before both ends; nothing if they do not belong to one outline, or if it
// is not hidden between them.
std::optional<Joint> joint_of(View<const float> coc_px, const OutlineEnd& a, const OutlineEnd& b);
// The direction in which an end continues, of length 1.
PlanePoint direction_of(const OutlineEnd& end);

}  // namespace petzval::engine
