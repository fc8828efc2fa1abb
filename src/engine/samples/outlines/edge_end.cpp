#include "engine/samples/outlines/edge_end.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace petzval::engine {
namespace {

constexpr int kMostTraced = 32;  // upper limit of edge_traced_px
constexpr int kLeastTraced = 3;

// The line through points that are one row apart: least squares.
struct Line {
    float start = 0, slope = 0, off = 0;  // off: root mean square of the deviations

    static Line through(const std::array<float, kMostTraced>& points, int n) {
        float along = 0, across = 0, squares = 0, products = 0;
        for (int i = 0; i < n; ++i) {
            const float a = float(i), c = points[std::size_t(i)];
            along += a, across += c, squares += a * a, products += a * c;
        }
        Line line;
        const float count = float(n), spread = count * squares - along * along;
        line.slope = spread > 0 ? (count * products - along * across) / spread : 0;
        line.start = (across - line.slope * along) / count;
        float deviations = 0;
        for (int i = 0; i < n; ++i) {
            const float d = points[std::size_t(i)] - line.at(i);
            deviations += d * d;
        }
        line.off = std::sqrt(deviations / count);
        return line;
    }
    float at(int i) const { return start + slope * float(i); }
};

float rise(float value, float from, float to) { return std::clamp((value - from) / (to - from), 0.0f, 1.0f); }

}  // namespace

PixelAt EdgeEnd::ahead(float t) const {
    return {at.x + nearest_pixel(off_x + t * into_x), at.y + nearest_pixel(off_y + t * into_y)};
}

EdgeEnds::EdgeEnds(const LitPicture& picture, View<const float> radii, const Mixtures& mixtures, float white,
                   Workers& workers)
    : radii_(radii),
      light_(Plane::uninitialised(radii.width(), radii.height())),
      dark_(completion_model.edge_dark * white) {
    parallel_for(light_.height(), workers, [&](int y) {
        float* const row = light_.row(y);
        for (int x = 0; x < light_.width(); ++x)
            row[x] = std::max(0.0f, luminance(comparable(picture.dim(x, y))));
        mixtures.for_each_in_row(y, [&](int x, const Mixture&) { row[x] = -1; });
    });
}

bool EdgeEnds::hides(PixelAt p, float coc_px) const {
    return radii_(p.x, p.y) <= coc_px - completion_model.step_px;
}

bool EdgeEnds::shows(PixelAt p, float coc_px) const {
    return radii_.rect().contains(p.x, p.y) && light_(p.x, p.y) >= 0 &&
           std::abs(radii_(p.x, p.y) - coc_px) < completion_model.step_px;
}

// Relative change of the light across a pixel, -1…1; 0 unless one surface shows there.
float EdgeEnds::change_at(const Place& place) const {
    const PixelAt p = place.pixel(), before = place.moved(0, -1).pixel(), after = place.moved(0, 1).pixel();
    if (!radii_.rect().contains(p.x, p.y)) return 0;
    const float coc_px = radii_(p.x, p.y);
    if (!shows(p, coc_px) || !shows(before, coc_px) || !shows(after, coc_px)) return 0;
    const float from = light_(before.x, before.y), to = light_(after.x, after.y);
    return (to - from) / (from + to + 2 * dark_);
}

// True if the light changes more here than beside. The change of an edge of two plain areas spreads over
// three pixels, and its centre is the edge.
bool EdgeEnds::point_at(const Place& place, Point& point) const {
    const float here = change_at(place), size = std::abs(here);
    if (!(size > 0)) return false;  // (nor is NaN an edge)
    const auto beside = [&](int by) {
        return std::max(0.0f, std::copysign(1.0f, here) * change_at(place.moved(0, by)));
    };
    const float before = beside(-1);
    if (before > size) return false;
    const float after = beside(1);
    if (after >= size) return false;
    point = {(after - before) / (before + size + after), before * before + size * size + after * after,
             here > 0};
    return true;
}

// Replaces `point` by the nearest one of its kind in the row of `place`, which is within_px from `across`.
// Both count from the place.
bool EdgeEnds::point_near(const Place& place, float across, float within_px, Point& point) const {
    const int middle = nearest_pixel(across);
    const bool rises = point.rises;
    float nearest = within_px;
    bool found = false;
    for (int c = middle - 1; c <= middle + 1; ++c) {
        Point p;
        if (!point_at(place.moved(0, c), p) || p.rises != rises) continue;
        p.across += float(c);
        const float off = std::abs(p.across - across);
        if (off < nearest) nearest = off, point = p, found = true;
    }
    return found;
}

// Follows the edge from `start` back, against `side`, as long as it is straight.
bool EdgeEnds::end_at(const Place& start, int side, EdgeEnd& end) const {
    const CompletionModel& model = completion_model;
    Point point;
    if (!point_at(start, point)) return false;
    std::array<float, kMostTraced> across{}, energy{};
    Line line;
    int n = 0;
    // (The first points decide a direction, so they may be a pixel off.)
    const auto within_px = [&] { return n < kLeastTraced ? 1 : 4 * model.edge_exact_px; };
    do {
        across[std::size_t(n)] = point.across, energy[std::size_t(n)] = point.energy;
        line = Line::through(across, ++n);
    } while (n < int(model.edge_traced_px) &&
             point_near(start.moved(-side * n, 0), line.at(n), within_px(), point));
    // (As for outlines, the mean deviation may be half of the largest.)
    const float most_off_px = 0.5f * model.outline_off_px;
    while (n > kLeastTraced && line.off > most_off_px)
        n = std::max(kLeastTraced, n / 2), line = Line::through(across, n);
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
    end.coc_px = radii_(end.at.x, end.at.y);
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
        if (!radii_.rect().contains(p.x, p.y)) return false;
        if (hides(p, end.coc_px)) return true;
        if (t > kCleanPx && light_(p.x, p.y) >= 0) return false;
    }
    return false;
}

float EdgeEnds::hidden_px(const EdgeEnd& end) const {
    const int most = int(completion_model.continues_px);
    bool hidden = false;
    for (int t = 1; t < most; ++t) {
        const PixelAt p = end.ahead(float(t));
        if (!radii_.rect().contains(p.x, p.y)) break;
        if (hidden && shows(p, end.coc_px)) return float(t);
        hidden = hidden || hides(p, end.coc_px);
    }
    return float(most);
}

std::vector<EdgeEnd> EdgeEnds::find(const Mixtures& mixtures, float to_px, Workers& workers) const {
    std::vector<std::vector<EdgeEnd>> rows(static_cast<std::size_t>(radii_.height()));
    parallel_for(radii_.height(), workers, [&](int y) {
        const auto look = [&](const Place& start, int side) {
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
