#include "engine/samples/outlines/edge_end.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/outlines/row_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

namespace petzval::engine {
namespace {

constexpr int kMostTraced = 32;  // upper limit of edge_traced_px
constexpr int kLeastTraced = 3;

float rise(float value, float from, float to) { return std::clamp((value - from) / (to - from), 0.0f, 1.0f); }

}  // namespace

PixelAt EdgeEnd::ahead(float t) const {
    return {at.x + nearest_pixel(off_x + t * into_x), at.y + nearest_pixel(off_y + t * into_y)};
}

// Follows the edge from `start` back, against `side`, as long as it is straight.
bool EdgeEnds::end_at(const EdgePlace& start, int side, EdgeEnd& end) const {
    const CompletionModel& model = completion_model;
    EdgePoint point;
    if (!points_.at(start, point)) return false;
    std::array<float, kMostTraced> across{}, energy{};
    RowLine line;
    int n = 0;
    // (The first points decide a direction, so they may be a pixel off.)
    const auto within_px = [&] { return n < kLeastTraced ? 1 : 4 * model.edge_exact_px; };
    do {
        across[std::size_t(n)] = point.across, energy[std::size_t(n)] = point.energy;
        line = RowLine::through(std::span(across).first(std::size_t(++n)));
    } while (n < int(model.edge_traced_px) &&
             points_.near(start.moved(-side * n, 0), line.at(n), within_px(), point));
    // (As for outlines, the mean deviation may be half of the largest.)
    const float most_off_px = 0.5f * model.outline_off_px;
    while (n > kLeastTraced && line.off > most_off_px)
        n = std::max(kLeastTraced, n / 2), line = RowLine::through(std::span(across).first(std::size_t(n)));
    if (n < kLeastTraced || line.off > most_off_px) return false;
    float change = 0;
    for (int i = 0; i < n; ++i) change += energy[std::size_t(i)];
    if (change < model.edge_change) return false;

    const float count = float(n);
    // The error of a slope: that of the points over the root of their spread along the edge.
    const float slope_error =
        std::max(line.off, model.edge_exact_px) * std::sqrt(12 / (count * (count * count - 1)));
    const float length = std::hypot(1.0f, line.slope);
    const float into_along = float(side) / length, into_across = -line.slope / length;
    end.at = start.pixel();
    end.off_x = start.upright ? line.start : 0, end.off_y = start.upright ? 0 : line.start;
    end.into_x = start.upright ? into_across : into_along;
    end.into_y = start.upright ? into_along : into_across;
    end.bright_is_right = point.rises == (start.upright ? side < 0 : side > 0);
    end.coc_px = points_.radii()(end.at.x, end.at.y);
    const PixelAt back = start.moved(side * (1 - n), nearest_pixel(line.at(n - 1))).pixel();
    // (The fitted line may leave the picture beside the points.)
    const bool known = points_.radii().rect().contains(back.x, back.y);
    end.slope = known ? (end.coc_px - points_.radii()(back.x, back.y)) / ((count - 1) * length) : 0;
    end.strength = rise(change, model.edge_change, 2 * model.edge_change);
    end.known_px = model.end_px / slope_error;
    return true;
}

// True if the edge reaches a nearer surface before it ends in sight.
bool EdgeEnds::goes_behind(const EdgeEnd& end) const {
    constexpr int kMixedPx = 10;  // length of an edge in the mixed pixels of a silhouette along it
    constexpr int kCleanPx = 2;
    for (int t = 1; t <= kMixedPx; ++t) {
        const PixelAt p = end.ahead(float(t));
        if (!points_.radii().rect().contains(p.x, p.y)) return false;
        if (points_.hides(p, end.coc_px)) return true;
        if (t > kCleanPx && points_.clean(p)) return false;
    }
    return false;
}

float EdgeEnds::hidden_px(const EdgeEnd& end) const {
    const int most = int(completion_model.continues_px);
    bool hidden = false;
    for (int t = 1; t < most; ++t) {
        const PixelAt p = end.ahead(float(t));
        if (!points_.radii().rect().contains(p.x, p.y)) break;
        const float coc_px = end.coc_px + float(t) * end.slope;
        if (hidden && (points_.shows(p, coc_px) || points_.shows_farther(p, coc_px))) return float(t);
        hidden = hidden || points_.hides(p, end.coc_px);
    }
    return float(most);
}

std::vector<EdgeEnd> EdgeEnds::find(const Mixtures& mixtures, float to_px, Workers& workers) const {
    std::vector<std::vector<EdgeEnd>> rows(static_cast<std::size_t>(points_.radii().height()));
    parallel_for(points_.radii().height(), workers, [&](int y) {
        const auto look = [&](const EdgePlace& start, int side) {
            EdgeEnd end;
            if (end_at(start, side, end) && std::abs(end.coc_px) <= to_px && goes_behind(end))
                rows[std::size_t(y)].push_back(end);
        };
        mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
            if (std::abs(m.far_coc_px) > to_px) return;
            for (const int side : {-1, 1})
                for (int c = -1; c <= 1; ++c)
                    look({true, y - side, x + c}, side), look({false, x - side, y + c}, side);
        });
    });
    std::vector<EdgeEnd> ends;
    for (const auto& row : rows) ends.insert(ends.end(), row.begin(), row.end());
    // (Several mixed pixels touch the same end.)
    const auto key = [](const EdgeEnd& e) {
        return std::tuple(e.at.y, e.at.x, std::abs(e.into_x) > std::abs(e.into_y), e.into_x > 0,
                          e.into_y > 0);
    };
    std::stable_sort(ends.begin(), ends.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    ends.erase(
        std::unique(ends.begin(), ends.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
        ends.end());
    return ends;
}

}  // namespace petzval::engine
