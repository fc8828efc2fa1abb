#include "engine/reference/surfaces.h"

#include "base/parallel.h"
#include "engine/reference/bright_points.h"
#include "kernel/model/radius_on_grid.h"

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

// A sample of a pixel around a corner: its pixel's place in the ring, and which surface it belongs to.
struct Member {
    std::uint32_t facet;
    int corner, place, group;
    float coc;
};

// Joins a sample with one of the next pixel of the ring, if they are one surface and closest to each other.
template <typename SlopeBeyond>
void join(std::vector<Member>& members, const Member& a, int next, const SlopeBeyond& slope_beyond) {
    const auto closest = [&](int place, float coc) {
        const Member* best = nullptr;
        for (const Member& m : members)
            if (m.place == place && (!best || std::abs(m.coc - coc) < std::abs(best->coc - coc))) best = &m;
        return best;
    };
    const Member* b = closest(next, a.coc);
    if (!b || !is_one_surface(b->coc - a.coc, -slope_beyond(a, next), slope_beyond(*b, a.place))) return;
    if (std::abs(closest(a.place, b->coc)->coc - b->coc) < std::abs(a.coc - b->coc)) return;
    const int from = b->group, to = a.group;
    for (Member& m : members)
        if (m.group == from) m.group = to;
}

float mean_coc(const std::vector<Member>& members, int group) {
    float total = 0;
    int n = 0;
    for (const Member& m : members)
        if (m.group == group) total += m.coc, ++n;
    return total / float(n);
}

Facet facet_of(Rgba colour, float coc_px) {
    const float coverage = std::clamp(colour.a, 0.0f, 1.0f);
    Facet facet{colour * (1 / coverage), coverage, 0, coc_px, {coc_px, coc_px, coc_px, coc_px}, {}};
    facet.colour.a = 1;
    return facet;
}

}  // namespace

Surfaces Surfaces::make(const CocSamples& samples, const OpenEdges& open, int margin, bool dims_itself,
                        bool blurs_in_focus, Workers& workers) {
    Surfaces surfaces;
    surfaces.dims_itself_ = dims_itself;
    surfaces.area_ = {open.left ? -margin : 0, open.top ? -margin : 0,
                      samples.width + (open.right ? margin : 0),
                      samples.height() + (open.bottom ? margin : 0)};
    surfaces.gather(samples);
    surfaces.connect(workers);
    surfaces.shift(blurs_in_focus);
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
    for (int place = 0; place < 4; ++place)
        for (const Member& a : members)
            if (a.place == place) join(members, a, (place + 1) % 4, slope_beyond);
    for (const Member& m : members) facets_[m.facet].corner_coc_px[m.corner] = mean_coc(members, m.group);
}

void Surfaces::shift(bool blurs_in_focus) {
    for (Facet& f : facets_)
        for (std::size_t i = 0; i < 4; ++i)
            f.shift_px[i] = float(kernel::radius_on_grid(double(f.corner_coc_px[i]), blurs_in_focus));
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
