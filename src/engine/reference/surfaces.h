// The samples of a frame as connected surfaces: what a lens ray can hit.
//
// Every sample is a small square facet at its pixel. Where neighbouring samples belong to one surface their
// facets share corners, so the surface is watertight; at a silhouette they do not, and rays pass between.
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace petzval::engine {

struct Facet {
    Rgba colour;                  // what a ray that hits it sees: straight colour, a = 1
    float coverage = 1;           // share of the pixel the facet fills, 0…1
    float coverage_in_front = 0;  // sum of the coverages of nearer facets of the pixel
    float coc_px = 0;             // signed radius at the centre
    float corner_coc_px[4];       // at (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
    float shift_px[4];            // how far the corners move from pupil point 0 to 1

    // True if a facet that covers part of its pixel is present for a ray of this chance (0…1); over all
    // chances it is present for exactly its coverage. Partly covering facets of one pixel lie beside each
    // other as long as there is room (two surfaces that meet in a pixel), so each takes the part of the unit
    // interval that follows the parts of the facets in front of it.
    bool takes(double chance_of_ray) const {
        const double from = chance_of_ray - double(coverage_in_front);
        return coverage >= 1 || from - std::floor(from) < double(coverage);
    }
};

// Facets of the picture and of a border of `margin` pixels around it. Beyond an open edge the outermost
// pixels are repeated; beyond a closed one there is nothing.
class Surfaces {
public:
    // Smallest and largest corner radius of a block of kBlock x kBlock pixels; min > max where it is empty.
    static constexpr int kBlock = 16;
    struct Bounds {
        float min = 1e30f, max = -1e30f;
    };

    // dims_itself: as Samples::deep_dims_itself. blurs_in_focus: as kernel::radius_on_grid has it.
    static Surfaces make(const CocSamples& samples, const OpenEdges& open, int margin, bool dims_itself,
                         bool blurs_in_focus, Workers& workers);
    // True if a facet that covers part of its pixel lets through a fraction of the light behind it (fog);
    // false if the rest of the pixel's area belongs to other facets (silhouettes).
    bool dims_itself() const { return dims_itself_; }

    // The area covered, in picture coordinates: the picture grown by the margin.
    Rect area() const { return area_; }
    // Facets of pixel (x, y) inside area(), nearest first; and the index of the first of them in facets().
    std::span<const Facet> at(int x, int y) const { return {facets_.data() + first(x, y), count(x, y)}; }
    std::uint32_t first(int x, int y) const { return first_[pixel(x, y)]; }
    std::span<const Facet> facets() const { return facets_; }
    int blocks_x() const { return (area_.width() + kBlock - 1) / kBlock; }
    int blocks_y() const { return (area_.height() + kBlock - 1) / kBlock; }
    Bounds block(int bx, int by) const {
        return blocks_[std::size_t(by) * std::size_t(blocks_x()) + std::size_t(bx)];
    }
    Rect block_area(int bx, int by) const {
        const int x = area_.x0 + bx * kBlock, y = area_.y0 + by * kBlock;
        return Rect{x, y, x + kBlock, y + kBlock}.intersected(area_);
    }

private:
    std::size_t pixel(int x, int y) const {
        return std::size_t(y - area_.y0) * std::size_t(area_.width()) + std::size_t(x - area_.x0);
    }
    std::size_t count(int x, int y) const { return first_[pixel(x, y) + 1] - first_[pixel(x, y)]; }
    void gather(const CocSamples& samples);
    void connect(Workers& workers);
    void connect_around_corner(int x, int y);
    void shift(bool blurs_in_focus);
    void bound();

    Rect area_;
    bool dims_itself_ = false;
    std::vector<std::uint32_t> first_;
    std::vector<Facet> facets_;
    std::vector<Bounds> blocks_;
};

}  // namespace petzval::engine
