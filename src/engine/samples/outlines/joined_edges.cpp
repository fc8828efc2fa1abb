#include "engine/samples/outlines/joined_edges.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/outlines/cells.h"
#include "engine/samples/outlines/from_cut.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

// Joins ends that face each other on one line, and continues the others as far as their direction is known.
class EdgeJoiner {
public:
    EdgeJoiner(const EdgeEnds& edges, std::vector<EdgeEnd> ends, int width, int height, Workers& workers)
        : ends_(std::move(ends)),
          hidden_px_(ends_.size()),
          columns_(width / kCell + 1),
          rows_(height / kCell + 1) {
        near_.resize(std::size_t(columns_) * std::size_t(rows_));
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            const PixelAt at = ends_[i].at;
            near_[std::size_t(at.y / kCell * columns_ + at.x / kCell)].push_back(int(i));
        }
        parallel_for(int(ends_.size()), workers,
                     [&](int i) { hidden_px_[std::size_t(i)] = edges.hidden_px(ends_[std::size_t(i)]); });
    }
    std::vector<CutEdges::Edge> joined(Workers& workers) const {
        std::vector<int> partner(ends_.size());
        parallel_for(int(ends_.size()), workers, [&](int i) { partner[std::size_t(i)] = partner_of(i); });
        std::vector<CutEdges::Edge> edges;
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            const int other = partner[i];
            if (other < 0 || partner[std::size_t(other)] != int(i)) {
                edges.push_back(alone(int(i)));
            } else if (other > int(i)) {
                edges.push_back(between(ends_[i], ends_[std::size_t(other)]));
            }
        }
        return edges;
    }

private:
    static bool on_line(const EdgeEnd& end, const FromCut& to) {
        const float error_px = completion_model.end_px * (0.5f + to.ahead / end.known_px);
        return to.ahead > 1 && std::abs(to.aside) < error_px;
    }
    // The nearest end that this one may join; -1: none.
    int partner_of(int number) const {
        constexpr float kMixedPx = 4;  // a surface becomes visible so long before its edge does
        const EdgeEnd& own = ends_[std::size_t(number)];
        int best = -1;
        float nearest = std::min(completion_model.continues_px, hidden_px_[std::size_t(number)] + kMixedPx);
        const PixelAt far = own.ahead(nearest);
        for (int v = cell_of(std::min(own.at.y, far.y) - kCell, rows_);
             v <= cell_of(std::max(own.at.y, far.y) + kCell, rows_); ++v)
            for (int u = cell_of(std::min(own.at.x, far.x) - kCell, columns_);
                 u <= cell_of(std::max(own.at.x, far.x) + kCell, columns_); ++u)
                for (const int i : near_[std::size_t(v * columns_ + u)]) {
                    const EdgeEnd& other = ends_[std::size_t(i)];
                    if (own.bright_is_right == other.bright_is_right ||
                        !one_surface(own.coc_px, other.coc_px))
                        continue;
                    const FromCut to(own, other);
                    if (to.ahead < nearest && on_line(own, to) && on_line(other, FromCut(other, own)))
                        best = i, nearest = to.ahead;
                }
        return best;
    }
    // It counts the less the shorter its direction is known: an edge that comes and goes with single pixels
    // must not move what is behind.
    CutEdges::Edge alone(int number) const {
        const EdgeEnd& e = ends_[std::size_t(number)];
        const CompletionModel& model = completion_model;
        const float known_px = std::min(e.known_px, model.continues_px);
        const float length_px = std::min(hidden_px_[std::size_t(number)] + model.end_px, known_px);
        const float strength = e.strength * known_px / model.continues_px;
        return {{e.at.x, e.at.y}, e.off_x, e.off_y, e.into_x, e.into_y, length_px, e.coc_px, strength};
    }
    static CutEdges::Edge between(const EdgeEnd& a, const EdgeEnd& b) {
        const float x = float(b.at.x - a.at.x) + b.off_x - a.off_x,
                    y = float(b.at.y - a.at.y) + b.off_y - a.off_y;
        const float length_px = std::hypot(x, y);
        return {{a.at.x, a.at.y}, a.off_x,
                a.off_y,          x / length_px,
                y / length_px,    length_px + completion_model.end_px,
                a.coc_px,         std::max(a.strength, b.strength)};
    }

    std::vector<EdgeEnd> ends_;
    std::vector<float> hidden_px_;
    int columns_, rows_;
    std::vector<std::vector<int>> near_;  // per cell: numbers of its ends
};

}  // namespace

std::vector<CutEdges::Edge> joined_edges(const EdgeEnds& edges, std::vector<EdgeEnd> ends, int width,
                                         int height, Workers& workers) {
    return EdgeJoiner(edges, std::move(ends), width, height, workers).joined(workers);
}

}  // namespace petzval::engine
