#include "engine/samples/outlines/hidden_outlines.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/outlines/cells.h"
#include "engine/samples/outlines/joined_outlines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

using Outline = HiddenOutlines::Outline;

static_assert(kContinuesPx + kTracedPx + kCell <= kOutlineReachPx);

// The middle of a pixel in the coordinates of an outline.
PlanePoint place_of(PixelAt p, const Outline& o) {
    return {float(p.x - o.at.x) + 0.5f, float(p.y - o.at.y) + 0.5f};
}

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
    outlines_ = joined_outlines(coc, std::move(ends), workers);
    sort_into_cells(coc.width(), coc.height());
}

void HiddenOutlines::sort_into_cells(int width, int height) {
    columns_ = (width + kCell - 1) / kCell;
    const int rows = (height + kCell - 1) / kCell;
    near_.resize(std::size_t(columns_) * std::size_t(rows));
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
        const Outline& o = outlines_[i];
        for (int v = cell_of(o.middle.y - o.around_px, rows); v <= cell_of(o.middle.y + o.around_px, rows);
             ++v)
            for (int u = cell_of(o.middle.x - o.around_px, columns_);
                 u <= cell_of(o.middle.x + o.around_px, columns_); ++u)
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
        const float right_px = o.arc.right_of(to), along_px = o.arc.along(to);
        const float beyond_px = std::max({0.0f, -along_px, along_px - o.length_px});
        constexpr std::size_t kUsual = 16;
        if (around.near_.empty()) around.near_.reserve(kUsual);
        around.near_.push_back({&o, to, right_px});
        around.distance_px_ = std::min(around.distance_px_, std::hypot(right_px, beyond_px));
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
        const bool from_left = near.right_px > 0, from_inside = from_left == o.same_is_left;
        if (from_inside && !own) continue;
        const float sign = from_left ? 1.0f : -1.0f;
        const PlanePoint from = place_of(shown, o);
        if (sign * o.arc.right_of(from) >= 0) continue;
        const float met = from_left ? o.arc.crossed(near.to, from) : o.arc.crossed(from, near.to);
        if (met < -model.end_px || met > o.length_px) continue;
        (from_inside ? open.within : open.unhidden) *=
            1 - std::min(1.0f, std::abs(o.arc.aside(near.to)) / model.barrier_soft_px);
    }
    return open;
}

}  // namespace petzval::engine
