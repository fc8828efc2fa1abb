#include "engine/samples/outlines/hidden_outlines.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace petzval::engine {
namespace {

using Outline = HiddenOutlines::Outline;

constexpr int kCell = 16;  // pixels on a side
static_assert(kContinuesPx + kTracedPx + kCell <= kOutlineReachPx);

// A column or row of `cells` cells, each `px` wide.
int cell_of(int at, int px, int cells) { return std::clamp(at / px, 0, cells - 1); }

constexpr float kForever = 1e9f;

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

// The middle of a pixel in the coordinates of an outline.
PlanePoint place_of(PixelAt p, const Outline& o) {
    return {float(p.x - o.at.x) + 0.5f, float(p.y - o.at.y) + 0.5f};
}

// Joins ends that belong to one outline, and continues the others.
class EndJoiner {
public:
    EndJoiner(View<const float> coc, std::vector<OutlineEnd> ends) : coc_(coc), ends_(std::move(ends)) {
        columns_ = coc.width() / kCell + 1, rows_ = coc.height() / kCell + 1;
        near_.resize(std::size_t(columns_) * std::size_t(rows_));
        for (std::size_t i = 0; i < ends_.size(); ++i) near_[cell(ends_[i].at)].push_back(facing(int(i)));
        // Largest number of ends in a cell. More, as noise in depth makes them, meet by chance, and testing
        // all pairs would take too long.
        constexpr std::size_t kMostInCell = 16;
        for (auto& in_cell : near_)
            if (in_cell.size() > kMostInCell) in_cell.clear();
    }
    std::vector<Outline> outlines(Workers& workers) const {
        std::vector<Joint> joints(ends_.size());
        parallel_for(int(ends_.size()), workers, [&](int i) { joints[std::size_t(i)] = best_joint(i); });
        std::vector<Outline> outlines;
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            const int other = joints[i].other;
            if (other < 0 || joints[std::size_t(other)].other != int(i))
                go_on(ends_[i], outlines);
            else if (ends_[std::size_t(other)].told_by == 0)  // too short to continue by itself
                add(ends_[i], joints[i].arc, hidden_for(ends_[i], {joints[i].arc}), outlines);
            else if (ends_[i].told_by > 0 && other > int(i))
                add(ends_[i], joints[i].arc, joints[i].length_px + completion_model.end_px, outlines);
        }
        return outlines;
    }

private:
    struct Joint {
        int other = -1;
        Arc arc{};
        float length_px = 0;
        bool sure = false;  // true if both ends know their direction

        bool better_than(const Joint& o) const {
            return o.other < 0 || (sure != o.sure ? sure : length_px < o.length_px);
        }
    };

    // Facts of an end that show soonest that two ends do not belong to one outline.
    struct Facing {
        int number;
        PixelAt at;
        PlanePoint into;
        float coc_px;
        bool same_is_left, tells;

        bool meets(const Facing& o) const {
            if (same_is_left == o.same_is_left || !one_surface(coc_px, o.coc_px)) return false;
            if (!tells && !o.tells) return false;
            const PlanePoint to{float(o.at.x - at.x), float(o.at.y - at.y)};
            const float ahead = to.x * into.x + to.y * into.y, back = -(to.x * o.into.x + to.y * o.into.y);
            const float squared = to.x * to.x + to.y * to.y, least = std::min(ahead, back);
            return least > 1 && 4 * least * least > squared &&
                   squared < completion_model.continues_px * completion_model.continues_px;
        }
    };

    std::size_t cell(PixelAt at) const { return std::size_t(at.y / kCell * columns_ + at.x / kCell); }
    Facing facing(int i) const {
        const OutlineEnd& end = ends_[std::size_t(i)];
        return {i, end.at, into_of(end), end.coc_px, end.same_is_left, end.told_by > 0};
    }
    // Area of the ends that this one can meet: within 60 degrees of its direction.
    static Rect reached(const Facing& end) {
        constexpr float kWidest = 0.87f * float(kContinuesPx);
        const auto least = [](float into) { return int(std::min(0.0f, float(kContinuesPx) * into)); };
        const int aside_x = int(kWidest * std::abs(end.into.y)),
                  aside_y = int(kWidest * std::abs(end.into.x));
        return {end.at.x + least(end.into.x) - aside_x, end.at.y + least(end.into.y) - aside_y,
                end.at.x - least(-end.into.x) + aside_x, end.at.y - least(-end.into.y) + aside_y};
    }
    Joint best_joint(int i) const {
        const Facing own = facing(i);
        Joint best;
        if (near_[cell(own.at)].empty()) return best;  // too many
        const Rect ahead = reached(own);
        for (int v = cell_of(ahead.y0, kCell, rows_); v <= cell_of(ahead.y1, kCell, rows_); ++v)
            for (int u = cell_of(ahead.x0, kCell, columns_); u <= cell_of(ahead.x1, kCell, columns_); ++u)
                for (const Facing& other : near_[std::size_t(v * columns_ + u)])
                    if (own.meets(other))
                        if (const auto joint = joint_of(i, other.number); joint && joint->better_than(best))
                            best = *joint;
        return best;
    }
    // The arc through the visible points before both ends.
    std::optional<Joint> joint_of(int i, int other) const {
        const OutlineEnd &a = ends_[std::size_t(i)], &b = ends_[std::size_t(other)];
        const PlanePoint to_b{float(b.at.x - a.at.x), float(b.at.y - a.at.y)};
        const bool sure = a.told_by > 0 && b.told_by > 0;
        std::array<PlanePoint, std::size_t(2) * kTracedPx> points;
        const auto both = of_both(a, b, to_b, points);
        Arc arc;
        if (!fit_line_or_arc(both, {0, 0}, to_b, arc)) return {};
        const float length = arc.along(to_b);
        if (length <= 1) return {};
        if (hidden_for(a, {arc}, sure) < length - kLeastTracedPx) return {};
        return Joint{other, arc, length, sure};
    }
    // Traced points next to the gap, about as many on either side as the gap is long.
    static std::span<const PlanePoint> of_both(const OutlineEnd& a, const OutlineEnd& b, PlanePoint to_b,
                                               std::span<PlanePoint> points) {
        const int most = std::max(kLeastTracedPx, int(std::hypot(to_b.x, to_b.y)));
        std::size_t n = 0;
        for (const PlanePoint& p : evidence(a, most)) points[n++] = p;
        for (const PlanePoint& p : evidence(b, most)) points[n++] = {to_b.x + p.x, to_b.y + p.y};
        return points.first(n);
    }
    static std::span<const PlanePoint> evidence(const OutlineEnd& end, int most) {
        constexpr int kFew = 3;
        const int count = end.told_by > 0 ? std::min(most, end.told_by) : std::min(kFew, end.traced_px);
        return std::span(end.traced).first(std::size_t(count));
    }
    static PlanePoint into_of(const OutlineEnd& end) {
        if (end.told_by > 0) return {end.arc.into_x, end.arc.into_y};
        const PlanePoint p = end.traced[kLeastJoinedPx - 1];
        const float length = std::hypot(p.x, p.y);
        return {-p.x / length, -p.y / length};
    }

    // Length over which a nearer surface hides the outline. If the outline becomes visible again as
    // expected, the length counts from the place where it is hidden again. sure: its course is certain.
    float hidden_for(const OutlineEnd& end, const Course& course, bool sure = false) const {
        const int most_px = int(completion_model.continues_px);
        for (int t = 1; t <= most_px; ++t) {
            if (side(end, course.at(float(t) + 0.5f)) == DepthSide::Nearer) continue;
            const int hidden_again = t + shown_for(end, course, t);
            if (t == 1 && !sure && hidden_again > t + kLeastTracedPx) return 0;
            if (hidden_again == t) return t == 1 ? 0 : float(t) + completion_model.end_px;
            t = hidden_again;
        }
        return float(most_px);
    }
    int shown_for(const OutlineEnd& end, const Course& course, int from) const {
        const float off = completion_model.end_px;
        for (int n = 0; from + n <= kContinuesPx; ++n) {
            const float along = float(from + n) + 0.5f;
            const DepthSide right = side(end, course.at(along, off)),
                            left = side(end, course.at(along, -off));
            const DepthSide inside = end.same_is_left ? left : right,
                            outside = end.same_is_left ? right : left;
            if (inside == DepthSide::Nearer && outside == DepthSide::Nearer) return std::max(1, n);
            if (inside == DepthSide::Farther || outside == DepthSide::Same) return 0;
        }
        return 0;
    }
    DepthSide side(const OutlineEnd& end, PlanePoint p) const {
        return depth_side(coc_, {end.at.x + int(std::floor(p.x)), end.at.y + int(std::floor(p.y))},
                          end.coc_px);
    }

    // Continues an end that has no partner.
    void go_on(const OutlineEnd& end, std::vector<Outline>& outlines) const {
        if (end.told_by == 0) return;
        const Course course{end.arc, end.arc.curvature == 0 ? kForever : float(end.told_by)};
        const float length = hidden_for(end, course);
        if (length <= 0) return;
        add(end, end.arc, std::min(length, course.bent_px), outlines);
        if (length > course.bent_px) add(end, course.rest(), length - course.bent_px, outlines);
    }
    // Adds an outline with its middle and the distance from there within which it decides.
    static void add(const OutlineEnd& end, const Arc& arc, float length, std::vector<Outline>& outlines) {
        constexpr int kLeastPx = 16, kAroundPx = 8;
        const float half = 0.5f * length;
        const PlanePoint middle = arc.at(half);
        outlines.push_back({end.at,
                            arc,
                            end.same_is_left,
                            end.coc_px,
                            length,
                            {end.at.x + nearest_pixel(middle.x), end.at.y + nearest_pixel(middle.y)},
                            std::max(kLeastPx, int(half) + kAroundPx)});
    }

    View<const float> coc_;
    std::vector<OutlineEnd> ends_;
    int columns_ = 0, rows_ = 0;
    std::vector<std::vector<Facing>> near_;
};

}  // namespace

HiddenOutlines::HiddenOutlines(View<const float> coc, Workers& workers) {
    if (coc.width() < 2 || coc.height() < 2) return;
    std::vector<std::vector<OutlineEnd>> rows(static_cast<std::size_t>(coc.height()));
    parallel_for(coc.height() - 1, workers, [&](int row) {
        for (int x = 1; x < coc.width(); ++x)
            if (const auto end = outline_end(coc, x, row + 1)) rows[std::size_t(row)].push_back(*end);
    });
    std::vector<OutlineEnd> ends;
    for (const auto& row : rows) ends.insert(ends.end(), row.begin(), row.end());
    outlines_ = EndJoiner(coc, std::move(ends)).outlines(workers);
    sort_into_cells(coc.width(), coc.height());
}

void HiddenOutlines::sort_into_cells(int width, int height) {
    columns_ = (width + kCell - 1) / kCell;
    const int rows = (height + kCell - 1) / kCell;
    near_.resize(std::size_t(columns_) * std::size_t(rows));
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        const Outline& o = outlines_[i];
        for (int v = cell_of(o.middle.y - o.around_px, kCell, rows);
             v <= cell_of(o.middle.y + o.around_px, kCell, rows); ++v)
            for (int u = cell_of(o.middle.x - o.around_px, kCell, columns_);
                 u <= cell_of(o.middle.x + o.around_px, kCell, columns_); ++u)
                near_[std::size_t(v * columns_ + u)].push_back(int(i));
    }
}

HiddenOutlines::Around HiddenOutlines::around(PixelAt hidden) const {
    Around around;
    if (outlines_.empty()) return around;
    for (const int i : near_[std::size_t(hidden.y / kCell * columns_ + hidden.x / kCell)]) {
        const Outline& o = outlines_[std::size_t(i)];
        // (Distance from the point, not from the cell, so that strips of a frame agree.)
        if (std::max(std::abs(hidden.x - o.middle.x), std::abs(hidden.y - o.middle.y)) > o.around_px)
            continue;
        const PlanePoint to = place_of(hidden, o);
        around.near_.push_back({&o, to, o.arc.right_of(to)});
        around.distance_px_ = std::min(around.distance_px_, std::abs(around.near_.back().right_px));
    }
    return around;
}

HiddenOutlines::Open HiddenOutlines::Around::open(PixelAt shown, float coc_px) const {
    const CompletionModel& model = completion_model;
    Open open;
    for (const Near& near : near_) {
        const Outline& o = *near.outline;
        const bool own = one_surface(o.coc_px, coc_px);
        if (!own && o.coc_px >= coc_px) continue;
        const bool from_left = own == o.same_is_left;
        const float sign = from_left ? 1.0f : -1.0f;
        if (sign * near.right_px <= 0) continue;
        const PlanePoint from = place_of(shown, o);
        if (sign * o.arc.right_of(from) >= 0) continue;
        const float met = from_left ? o.arc.crossed(near.to, from) : o.arc.crossed(from, near.to);
        if (met < -model.end_px || met > o.length_px) continue;
        (own ? open.within : open.unhidden) *=
            1 - std::min(1.0f, std::abs(o.arc.aside(near.to)) / model.barrier_soft_px);
    }
    return open;
}

}  // namespace petzval::engine
