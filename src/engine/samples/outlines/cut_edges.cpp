#include "engine/samples/outlines/cut_edges.h"

#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"
#include "engine/samples/outlines/cells.h"
#include "engine/samples/outlines/from_cut.h"
#include "engine/samples/outlines/joined_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {
namespace {

// An edge concerns hidden points that are at most this much farther from it than half its length.
constexpr float kAroundPx = 16;

bool is_on(const CutEdges::Edge& edge, float coc_px) {
    return std::abs(edge.coc_px - coc_px) <= completion_model.apart_px();
}

}  // namespace

CutEdges::CutEdges(const LitPicture& picture, View<const float> radii, const Mixtures& mixtures, float white,
                   float to_px, Workers& workers) {
    if (white <= 0 || to_px < 0 || completion_model.continues_px <= 0 || mixtures.empty()) return;
    const EdgeEnds ends(picture, radii, mixtures, white, workers);
    edges_ = joined_edges(ends, ends.find(mixtures, to_px, workers), radii.width(), radii.height(), workers);
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

// Only edges for which counts(edge) is true.
template <typename Counts>
CutEdges::Around CutEdges::around(Point hidden, float within_px, const Counts& counts) const {
    Around around;
    if (edges_.empty()) return around;
    for (const int i : near_[std::size_t(hidden.y / kCell * columns_ + hidden.x / kCell)]) {
        const Edge& e = edges_[std::size_t(i)];
        if (!counts(e)) continue;
        const FromCut at(e, hidden);
        const float half = 0.5f * e.length_px;
        // (By distance and not by cell, so that strips of a frame agree.)
        if (std::abs(at.aside) > std::min(within_px, half + kAroundPx) ||
            at.ahead < -completion_model.end_px - std::min(within_px, kAroundPx) ||
            at.ahead > e.length_px + std::min(within_px, kAroundPx))
            continue;
        constexpr std::size_t kUsual = 32;
        if (around.near_.empty()) around.near_.reserve(kUsual);
        around.near_.push_back({&e, at.aside, at.ahead});
    }
    return around;
}

CutEdges::Around CutEdges::around(Point hidden) const {
    return around(hidden, std::numeric_limits<float>::infinity(), [](const Edge&) { return true; });
}

CutEdges::Around CutEdges::around(Point hidden, float within_px, float coc_px) const {
    return around(hidden, within_px, [coc_px](const Edge& e) { return is_on(e, coc_px); });
}

float CutEdges::Around::passes(Point shown, float coc_px) const {
    const CompletionModel& model = completion_model;
    float open = 1;
    for (const Near& near : near_) {
        const Edge& e = *near.edge;
        if (!is_on(e, coc_px)) continue;
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
