#include "engine/samples/outlines/joint.h"

#include "engine/samples/outlines/course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace petzval::engine {
namespace {

std::span<const PlanePoint> evidence(const OutlineEnd& end, int most) {
    constexpr int kFew = 3;
    const int count = end.told_by > 0 ? std::min(most, end.told_by) : std::min(kFew, end.traced_px);
    return std::span(end.traced).first(std::size_t(count));
}

// Traced points next to the gap, about as many on either side as the gap is long.
std::span<const PlanePoint> of_both(const OutlineEnd& a, const OutlineEnd& b, PlanePoint to_b,
                                    std::span<PlanePoint> points) {
    const int most = std::max(kLeastTracedPx, int(std::hypot(to_b.x, to_b.y)));
    std::size_t n = 0;
    for (const PlanePoint& p : evidence(a, most)) points[n++] = p;
    for (const PlanePoint& p : evidence(b, most)) points[n++] = {to_b.x + p.x, to_b.y + p.y};
    return points.first(n);
}

}  // namespace

std::optional<Joint> joint_of(View<const float> coc_px, const OutlineEnd& a, const OutlineEnd& b) {
    const PlanePoint to_b{float(b.at.x - a.at.x), float(b.at.y - a.at.y)};
    const bool sure = a.told_by > 0 && b.told_by > 0;
    std::array<PlanePoint, std::size_t(2) * kTracedPx> points;
    const auto both = of_both(a, b, to_b, points);
    Arc arc;
    if (!fit_line_or_arc(both, {0, 0}, to_b, arc)) return {};
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
