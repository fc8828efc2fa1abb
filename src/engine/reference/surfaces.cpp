#include "engine/reference/surfaces.h"

#include "base/parallel.h"
#include "engine/reference/bright_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kAlwaysConnectedPx = 1.0f;

// True if samples of neighbouring pixels are one surface. On a plane the radius changes by the same amount
// from pixel to pixel, so a step that nearly equals the one before it or the one after it (signed changes of
// radius) continues a slope. A step of up to one pixel of radius hides nothing wider than that, and always
// continues the surface.
bool is_one_surface(float step_px, float step_before_px, float step_after_px) {
    const float most_off = 0.5f * std::abs(step_px);
    return std::abs(step_px) <= kAlwaysConnectedPx || std::abs(step_px - step_before_px) <= most_off ||
           std::abs(step_px - step_after_px) <= most_off;
}

Facet facet_of(Rgba colour, float coc_px) {
    const float coverage = std::clamp(colour.a, 0.0f, 1.0f);
    Facet facet{colour * (1 / coverage), coverage, 0, coc_px, {coc_px, coc_px, coc_px, coc_px}};
    facet.colour.a = 1;
    return facet;
}

}  // namespace

Surfaces Surfaces::make(const CocSamples& samples, const OpenEdges& open, int margin, bool dims_itself,
                        Workers& workers) {
    Surfaces surfaces;
    surfaces.dims_itself_ = dims_itself;
    surfaces.area_ = {open.left ? -margin : 0, open.top ? -margin : 0,
                      samples.width + (open.right ? margin : 0),
                      samples.height() + (open.bottom ? margin : 0)};
    surfaces.gather(samples);
    surfaces.connect(workers);
    surfaces.bound();
    return surfaces;
}

void Surfaces::gather(const CocSamples& samples) {
    const CocSamplesView view = samples;
    first_.reserve(std::size_t(area_.width()) * std::size_t(area_.height()) + 1);
    facets_.reserve(samples.samples.size());
    for (int y = area_.y0; y < area_.y1; ++y)
        for (int x = area_.x0; x < area_.x1; ++x) {
            first_.push_back(std::uint32_t(facets_.size()));
            float covered = 0;
            for (const CocSample& s :
                 view.at(std::clamp(x, 0, samples.width - 1), std::clamp(y, 0, samples.height() - 1)))
                if (s.colour.a > kLeastCoverage) {
                    facets_.push_back(facet_of(s.colour, s.coc_px));
                    facets_.back().coverage_in_front = covered;
                    covered += facets_.back().coverage;
                }
        }
    first_.push_back(std::uint32_t(facets_.size()));
}

void Surfaces::connect(Workers& workers) {
    // Each corner belongs to the four facets' own slots, so rows of corners can be done in parallel.
    parallel_for(area_.height() - 1, workers, [&](int row) {
        for (int x = area_.x0 + 1; x < area_.x1; ++x) connect_around_corner(x, area_.y0 + 1 + row);
    });
}

// Joins the samples of the four pixels that meet at the top-left corner of (x, y) into surfaces and gives all
// samples of a surface the same radius there, the mean of theirs.
void Surfaces::connect_around_corner(int x, int y) {
    // Pixels around the corner in ring order, and which of their corners it is.
    const std::array<std::array<int, 3>, 4> ring{
        {{x - 1, y - 1, 3}, {x, y - 1, 2}, {x, y, 0}, {x - 1, y, 1}}};
    // Most corners: one sample each, all close together.
    bool simple = true;
    float low = 1e30f, high = -1e30f, sum = 0;
    for (const auto& [px, py, corner] : ring) {
        if (count(px, py) != 1) {
            simple = false;
            break;
        }
        const float coc = at(px, py)[0].coc_px;
        low = std::min(low, coc), high = std::max(high, coc), sum += coc;
    }
    if (simple && high - low <= kAlwaysConnectedPx) {
        for (const auto& [px, py, corner] : ring) facets_[first(px, py)].corner_coc_px[corner] = sum / 4;
        return;
    }

    struct Member {
        std::uint32_t facet;
        int corner, place, group;
        float coc;
    };
    thread_local std::vector<Member> members;
    members.clear();
    for (int place = 0; place < 4; ++place) {
        const auto& [px, py, corner] = ring[std::size_t(place)];
        for (std::size_t k = 0; k < count(px, py); ++k) {
            const std::uint32_t facet = first(px, py) + std::uint32_t(k);
            members.push_back({facet, corner, place, int(members.size()), facets_[facet].coc_px});
        }
    }
    // The slope on the far side of a sample, away from its neighbour: to the closest sample of the next pixel
    // out.
    const auto slope_beyond = [&](const Member& from, int to_place) {
        const int dx = ring[std::size_t(from.place)][0] - ring[std::size_t(to_place)][0];
        const int dy = ring[std::size_t(from.place)][1] - ring[std::size_t(to_place)][1];
        const int ox = ring[std::size_t(from.place)][0] + dx, oy = ring[std::size_t(from.place)][1] + dy;
        float best = 1e30f;
        if (area_.contains(ox, oy))
            for (const Facet& f : at(ox, oy))
                if (std::abs(f.coc_px - from.coc) < std::abs(best)) best = f.coc_px - from.coc;
        return best;
    };
    // Each pair of neighbours (the four edges of the ring) joins its mutually closest connected samples.
    for (int place = 0; place < 4; ++place) {
        const int next = (place + 1) % 4;
        for (Member& a : members) {
            if (a.place != place) continue;
            Member* best = nullptr;
            for (Member& b : members)
                if (b.place == next && (!best || std::abs(b.coc - a.coc) < std::abs(best->coc - a.coc)))
                    best = &b;
            if (!best ||
                !is_one_surface(best->coc - a.coc, -slope_beyond(a, next), slope_beyond(*best, place)))
                continue;
            bool mutual = true;
            for (const Member& other : members)
                if (other.place == place && std::abs(other.coc - best->coc) < std::abs(a.coc - best->coc))
                    mutual = false;
            if (!mutual) continue;
            const int from = best->group, to = a.group;
            for (Member& m : members)
                if (m.group == from) m.group = to;
        }
    }
    for (const Member& m : members) {
        float total = 0;
        int n = 0;
        for (const Member& other : members)
            if (other.group == m.group) total += other.coc, ++n;
        facets_[m.facet].corner_coc_px[m.corner] = total / float(n);
    }
}

void Surfaces::bound() {
    blocks_.assign(std::size_t(blocks_x()) * std::size_t(blocks_y()), {});
    for (int by = 0; by < blocks_y(); ++by)
        for (int bx = 0; bx < blocks_x(); ++bx) {
            Bounds& bounds = blocks_[std::size_t(by) * std::size_t(blocks_x()) + std::size_t(bx)];
            const Rect r = block_area(bx, by);
            for (int y = r.y0; y < r.y1; ++y)
                for (int x = r.x0; x < r.x1; ++x)
                    for (const Facet& f : at(x, y))
                        for (const float c : f.corner_coc_px)
                            bounds.min = std::min(bounds.min, c), bounds.max = std::max(bounds.max, c);
        }
}

}  // namespace petzval::engine
