#include "engine/samples/outlines/course.h"

#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

DepthSide side(View<const float> coc_px, const OutlineEnd& end, PlanePoint p) {
    return depth_side(coc_px, {end.at.x + int(std::floor(p.x)), end.at.y + int(std::floor(p.y))}, end.coc_px);
}

// Length over which the outline is visible as expected from there on, px; 0: it is not visible so.
int shown_for(View<const float> coc_px, const OutlineEnd& end, const Course& course, int from) {
    const float off = completion_model.end_px;
    for (int n = 0; from + n <= kContinuesPx; ++n) {
        const float along = float(from + n) + 0.5f;
        const DepthSide right = side(coc_px, end, course.at(along, off)),
                        left = side(coc_px, end, course.at(along, -off));
        const DepthSide inside = end.same_is_left ? left : right, outside = end.same_is_left ? right : left;
        if (inside == DepthSide::Nearer && outside == DepthSide::Nearer) return std::max(1, n);
        if (inside == DepthSide::Farther || outside == DepthSide::Same) return 0;
    }
    return 0;
}

}  // namespace

float hidden_px(View<const float> coc_px, const OutlineEnd& end, const Course& course, bool sure) {
    const int most_px = int(completion_model.continues_px);
    for (int t = 1; t <= most_px; ++t) {
        if (side(coc_px, end, course.at(float(t) + 0.5f)) == DepthSide::Nearer) continue;
        const int hidden_again = t + shown_for(coc_px, end, course, t);
        if (t == 1 && !sure && hidden_again > t + kLeastTracedPx) return 0;
        if (hidden_again == t) return t == 1 ? 0 : float(t) + completion_model.end_px;
        t = hidden_again;
    }
    return float(most_px);
}

}  // namespace petzval::engine
