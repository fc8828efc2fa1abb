#include "engine/samples/outlines/joint.h"

#include "engine/samples/outlines/course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace petzval::engine {
namespace {

// The traced points of an end that was traced by at least `least` points and fits a line or an arc; else the
// few next to the gap.
std::span<const PlanePoint> evidence(const OutlineEnd& end, int least, int most) {
    constexpr int kFew = 3;
    const int count = end.told_by >= least ? std::min(most, end.told_by) : std::min(kFew, end.traced_px);
    return std::span(end.traced).first(std::size_t(count));
}

// The line or arc through traced points next to the gap, about as many on either side as the gap is long.
// False: there is none.
bool fit(const OutlineEnd& a, const OutlineEnd& b, PlanePoint to_b, int least, Arc& arc) {
    const int most = std::max(kLeastTracedPx, int(std::hypot(to_b.x, to_b.y)));
    std::array<PlanePoint, std::size_t(2) * kTracedPx> points;
    std::size_t n = 0;
    for (const PlanePoint& p : evidence(a, least, most)) points[n++] = p;
    for (const PlanePoint& p : evidence(b, least, most)) points[n++] = {to_b.x + p.x, to_b.y + p.y};
    return fit_line_or_arc(std::span(points).first(n), {0, 0}, to_b, arc);
}

bool well_traced(const OutlineEnd& end) { return end.told_by >= kWellTracedPx; }

}  // namespace

std::optional<Joint> joint_of(View<const float> coc_px, const OutlineEnd& a, const OutlineEnd& b) {
    const PlanePoint to_b{float(b.at.x - a.at.x), float(b.at.y - a.at.y)};
    bool sure = a.told_by > 0 && b.told_by > 0;
    Arc arc;
    if (!fit(a, b, to_b, 1, arc)) {
        // The outline may turn a corner soon after it becomes visible again.
        if (well_traced(a) == well_traced(b) || !fit(a, b, to_b, kWellTracedPx, arc)) return {};
        sure = false;
    }
    const float length = arc.along(to_b);
    if (length <= 1) return {};
    if (hidden_px(coc_px, a, {arc}, sure) < length - kLeastTracedPx) return {};
    return Joint{-1, arc, length, sure};
}

PlanePoint direction_of(const OutlineEnd& end) {
    if (end.told_by > 0) return {end.arc.into_x, end.arc.into_y};
    const PlanePoint p = end.traced[kLeastJoinedPx - 1];
    const float length = std::hypot(p.x, p.y);
    return {-p.x / length, -p.y / length};
}

}  // namespace petzval::engine
