#include "engine/samples/outlines/joined_outlines.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/outlines/cells.h"
#include "engine/samples/outlines/course.h"
#include "engine/samples/outlines/joint.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

using Outline = HiddenOutlines::Outline;

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
                add(ends_[i], joints[i].arc, hidden_px(coc_, ends_[i], {joints[i].arc}), outlines);
            else if (ends_[i].told_by > 0 && other > int(i))
                add(ends_[i], joints[i].arc, joints[i].length_px + completion_model.end_px, outlines);
        }
        return outlines;
    }

private:
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
        return {i, end.at, direction_of(end), end.coc_px, end.same_is_left, end.told_by > 0};
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
        for (int v = cell_of(ahead.y0, rows_); v <= cell_of(ahead.y1, rows_); ++v)
            for (int u = cell_of(ahead.x0, columns_); u <= cell_of(ahead.x1, columns_); ++u)
                for (const Facing& other : near_[std::size_t(v * columns_ + u)])
                    if (own.meets(other))
                        if (const auto joint =
                                joint_of(coc_, ends_[std::size_t(i)], ends_[std::size_t(other.number)]);
                            joint && joint->better_than(best))
                            best = *joint, best.other = other.number;
        return best;
    }
    // Continues an end that has no partner.
    void go_on(const OutlineEnd& end, std::vector<Outline>& outlines) const {
        if (end.told_by == 0) return;
        const Course course{end.arc, end.arc.curvature == 0 ? kForever : float(end.told_by)};
        const float length = hidden_px(coc_, end, course);
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

std::vector<Outline> joined_outlines(View<const float> coc_px, std::vector<OutlineEnd> ends,
                                     Workers& workers) {
    return EndJoiner(coc_px, std::move(ends)).outlines(workers);
}

}  // namespace petzval::engine
