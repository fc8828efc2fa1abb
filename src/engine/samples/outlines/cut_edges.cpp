#include "engine/samples/outlines/cut_edges.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/outlines/edge_end.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

constexpr int kCell = 16;  // pixels on a side
// An edge concerns hidden points that are at most this much farther from it than half its length.
constexpr float kAroundPx = 16;

int cell_of(int at, int cells) { return std::clamp(at / kCell, 0, cells - 1); }

// A point in the coordinates of an edge or of an end of one.
struct FromCut {
    float ahead, aside;
    template <typename Cut>
    FromCut(const Cut& cut, float x, float y)
        : ahead((x - cut.off_x) * cut.into_x + (y - cut.off_y) * cut.into_y),
          aside((y - cut.off_y) * cut.into_x - (x - cut.off_x) * cut.into_y) {}
    FromCut(const CutEdges::Edge& edge, CutEdges::Point p)
        : FromCut(edge, float(p.x - edge.at.x), float(p.y - edge.at.y)) {}
    FromCut(const EdgeEnd& from, const EdgeEnd& to)
        : FromCut(from, float(to.at.x - from.at.x) + to.off_x, float(to.at.y - from.at.y) + to.off_y) {}
};

// Joins ends that face each other on one line, and continues the others as far as their direction is known.
class EdgeJoiner {
public:
    EdgeJoiner(const EdgeEnds& edges, std::vector<EdgeEnd> ends, int width, int height)
        : ends_(std::move(ends)), columns_(width / kCell + 1), rows_(height / kCell + 1) {
        near_.resize(std::size_t(columns_) * std::size_t(rows_));
        for (std::size_t i = 0; i < ends_.size(); ++i) {
            const PixelAt at = ends_[i].at;
            near_[std::size_t(at.y / kCell * columns_ + at.x / kCell)].push_back(int(i));
            hidden_px_.push_back(edges.hidden_px(ends_[i]));
        }
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

CutEdges::CutEdges(const LitPicture& picture, View<const float> radii, const Mixtures& mixtures, float white,
                   float to_px, Workers& workers) {
    if (white <= 0 || to_px < 0 || completion_model.continues_px <= 0 || mixtures.empty()) return;
    const EdgeEnds ends(picture, radii, mixtures, white, workers);
    edges_ =
        EdgeJoiner(ends, ends.find(mixtures, to_px, workers), radii.width(), radii.height()).joined(workers);
    sort_into_cells(radii.width(), radii.height());
}

void CutEdges::sort_into_cells(int width, int height) {
    columns_ = (width + kCell - 1) / kCell;
    const int rows = (height + kCell - 1) / kCell;
    near_.resize(std::size_t(columns_) * std::size_t(rows));
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const Edge& e = edges_[i];
        const float half = 0.5f * e.length_px, across = half + kAroundPx;
        const int x = e.at.x + nearest_pixel(half * e.into_x), y = e.at.y + nearest_pixel(half * e.into_y);
        // Half the sides of the rectangle around the square that around() allows.
        const int side = int((std::abs(e.into_x) + std::abs(e.into_y)) * across) + 2;
        for (int v = cell_of(y - side, rows); v <= cell_of(y + side, rows); ++v)
            for (int u = cell_of(x - side, columns_); u <= cell_of(x + side, columns_); ++u)
                near_[std::size_t(v * columns_ + u)].push_back(int(i));
    }
}

CutEdges::Around CutEdges::around(Point hidden, float within_px) const {
    Around around;
    if (edges_.empty()) return around;
    for (const int i : near_[std::size_t(hidden.y / kCell * columns_ + hidden.x / kCell)]) {
        const Edge& e = edges_[std::size_t(i)];
        const FromCut at(e, hidden);
        const float half = 0.5f * e.length_px;
        // (By distance and not by cell, so that strips of a frame agree.)
        if (std::abs(at.aside) > std::min(within_px, half + kAroundPx) ||
            at.ahead < -completion_model.end_px - std::min(within_px, kAroundPx) ||
            at.ahead > e.length_px + std::min(within_px, kAroundPx))
            continue;
        around.near_.push_back({e, at.aside, at.ahead});
    }
    return around;
}

float CutEdges::Around::passes(Point shown, float coc_px) const {
    const CompletionModel& model = completion_model;
    float open = 1;
    for (const Near& near : near_) {
        const Edge& e = near.edge;
        if (std::abs(e.coc_px - coc_px) > model.apart_px()) continue;
        const FromCut at(e, shown);
        const float a = near.aside, b = at.aside;
        if (a * b >= 0) continue;
        const float met = (near.ahead * b - at.ahead * a) / (b - a);
        if (met < -model.end_px || met > e.length_px) continue;
        // (A witness close behind the edge shows both of its sides, so it is cut as well.)
        open *= 1 - e.strength * std::min(1.0f, std::abs(a) / model.barrier_soft_px);
    }
    return std::max(open, kCut);
}

}  // namespace petzval::engine
