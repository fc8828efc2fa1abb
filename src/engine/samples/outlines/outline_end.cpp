#include "engine/samples/outlines/outline_end.h"

#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// Each turns right from the one before.
constexpr std::array<PixelAt, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

struct Beside {
    PixelAt right, left;
};
// The pixels to both sides of a step from a corner (y points down).
Beside beside(PixelAt at, PixelAt step) {
    if (step.x > 0) return {{at.x, at.y}, {at.x, at.y - 1}};
    if (step.x < 0) return {{at.x - 1, at.y - 1}, {at.x - 1, at.y}};
    if (step.y > 0) return {{at.x - 1, at.y}, {at.x, at.y}};
    return {{at.x, at.y - 1}, {at.x - 1, at.y - 1}};
}

// Follows an outline from the point where it is hidden.
class Tracer {
public:
    Tracer(View<const float> coc, OutlineEnd& end) : coc_(coc), end_(end) {}

    void trace() {
        for (int k = 0; k < 4; ++k) {
            const auto [right, left] = beside(end_.at, kSteps[std::size_t(k)]);
            const DepthSide r = side(right), l = side(left);
            if ((r == DepthSide::Same && l == DepthSide::Farther) ||
                (l == DepthSide::Same && r == DepthSide::Farther)) {
                // The trace runs opposite to the outline's continuation.
                end_.same_is_left = r == DepthSide::Same;
                return follow(k);
            }
        }
    }

private:
    DepthSide side(PixelAt pixel) const { return depth_side(coc_, pixel, end_.coc_px); }
    void follow(int k) {
        const bool same_is_right = end_.same_is_left;
        PixelAt at = end_.at;
        while (end_.traced_px < kTracedPx) {
            const PixelAt step = kSteps[std::size_t(k)];
            end_.traced[std::size_t(end_.traced_px++)] = {float(at.x - end_.at.x) + 0.5f * float(step.x),
                                                          float(at.y - end_.at.y) + 0.5f * float(step.y)};
            at = {at.x + step.x, at.y + step.y};
            const auto [right, left] = beside(at, step);
            const DepthSide ahead = side(same_is_right ? right : left),
                            other = side(same_is_right ? left : right);
            if (ahead == DepthSide::Nearer || other == DepthSide::Nearer) return;
            const int to_same = same_is_right ? 1 : 3;  // turns
            if (ahead == DepthSide::Farther)
                k = (k + to_same) % 4;
            else if (other == DepthSide::Same)
                k = (k + 4 - to_same) % 4;
        }
    }

    View<const float> coc_;
    OutlineEnd& end_;
};

// True if a chain of pixel sides never turns back in columns or rows, as along every line. That around the
// tip of a strand does.
bool runs_one_way(std::span<const PlanePoint> points) {
    float least_x = 1, most_x = -1, least_y = 1, most_y = -1;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const float x = points[i].x - points[i - 1].x;
        const float y = points[i].y - points[i - 1].y;
        least_x = std::min(least_x, x);
        most_x = std::max(most_x, x);
        least_y = std::min(least_y, y);
        most_y = std::max(most_y, y);
    }
    return (least_x >= 0 || most_x <= 0) && (least_y >= 0 || most_y <= 0);
}

// The longest traced part on one line or arc decides the continuation.
void find_arc(OutlineEnd& end) {
    constexpr int kLeastOfArc = 14;
    for (const int n : {end.traced_px, 24, 18, kLeastOfArc, 12, 8, kLeastTracedPx}) {
        if (n > end.traced_px || n < kLeastTracedPx) continue;
        const auto points = std::span(end.traced).first(std::size_t(n));
        const PlanePoint into{-points[kLeastTracedPx - 1].x, -points[kLeastTracedPx - 1].y};
        end.told_by = n;
        if (n >= kLeastOfArc) {
            if (fit_line_or_arc(points, {0, 0}, into, end.arc)) return;
            continue;
        }
        const FittedArc line = fitted_line(points, {0, 0}, into);
        end.arc = line.arc;
        if (line.worst_px <= completion_model.outline_off_px && runs_one_way(points)) return;
    }
    end.told_by = 0;
}

bool tells(const FittedArc& fitted) {
    return fitted.worst_px <= completion_model.outline_off_px &&
           fitted.mean_px <= 0.5f * completion_model.outline_off_px;
}

}  // namespace

DepthSide depth_side(float coc, float surface) {
    // The step is smaller than that of one_surface(): between touching pixels, a smaller step is an
    // outline already.
    if (std::abs(coc - surface) < completion_model.step_px) return DepthSide::Same;
    return coc < surface ? DepthSide::Nearer : DepthSide::Farther;
}

DepthSide depth_side(View<const float> coc, PixelAt pixel, float surface) {
    return coc.rect().contains(pixel.x, pixel.y) ? depth_side(coc(pixel.x, pixel.y), surface)
                                                 : DepthSide::Nearer;
}

bool fit_line_or_arc(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into, Arc& best) {
    FittedArc fitted = fitted_line(points, start, into);
    if (!tells(fitted)) fitted = fitted_arc(points, start, into);
    best = fitted.arc;
    return tells(fitted);
}

std::optional<OutlineEnd> outline_end(View<const float> coc, int x, int y) {
    std::array<float, 4> met{coc(x - 1, y - 1), coc(x, y - 1), coc(x - 1, y), coc(x, y)};
    const auto [low, high] = std::minmax_element(met.begin(), met.end());
    if (depth_side(*low, *high) == DepthSide::Same) return {};
    std::sort(met.begin(), met.end());
    for (const float own : {met[1], met[2]})
        if (depth_side(met[0], own) == DepthSide::Nearer && depth_side(met[3], own) == DepthSide::Farther) {
            OutlineEnd end{};
            end.at = {x, y}, end.coc_px = own;
            Tracer(coc, end).trace();
            find_arc(end);
            if (end.traced_px < kLeastJoinedPx) return {};
            return end;
        }
    return {};
}

}  // namespace petzval::engine
