// The hidden course of an outline, and how far a nearer surface hides it.
#pragma once

#include "engine/samples/outlines/outline_end.h"

namespace petzval::engine {

inline constexpr float kForever = 1e9f;

// An arc that continues straight after a while.
struct Course {
    Arc arc;
    float bent_px = kForever;

    Arc rest() const {
        Arc straight = arc.from(bent_px);
        straight.curvature = 0;
        return straight;
    }
    PlanePoint at(float along, float right_px = 0) const {
        const Arc here = along <= bent_px ? arc.from(along) : rest().from(along - bent_px);
        return {here.start.x - right_px * here.into_y, here.start.y + right_px * here.into_x};
    }
};

// Length over which a nearer surface hides the course of an end, px. If the outline becomes visible again as
// expected, the length counts from the place where it is hidden again. sure: its course is certain.
float hidden_px(View<const float> coc_px, const OutlineEnd& end, const Course& course, bool sure = false);

}  // namespace petzval::engine
