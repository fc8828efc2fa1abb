// Outlines of surfaces that something nearer hides: where one is hidden, it goes on as it came.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/outlines/outline_end.h"

#include <vector>

namespace petzval::engine {

// What it tells of a place depends on nothing farther away.
constexpr int kOutlineReachPx = 160;

// Found from radii alone: where three surfaces meet in a picture, the nearest hides how the outline of the
// middle one, before the farthest, goes on. Two ends of it that lie on one line or arc are one outline, all
// of which is hidden between them ("relatable": P. Kellman, T. Shipley, "A theory of visual interpolation in
// object perception", 1991). Another end goes on as it came, bent no longer than it is seen to be, up to
// where what hides it ends.
class HiddenOutlines {
public:
    HiddenOutlines() = default;
    // coc_px: of each pixel, as the picture states it.
    HiddenOutlines(View<const float> coc_px, Workers& workers);

    // Of a surface at coc_px that shows at `shown`: whether it goes on to a hidden point, 1, or 0 beyond its
    // own outline; and whether it can be what is to be seen there, 0 where the outline of a nearer surface
    // begins between them.
    struct Open {
        float within = 1, unhidden = 1;
    };
    Open open(PixelAt shown, PixelAt hidden, float coc_px) const;

    struct Outline {
        PixelAt at;  // places count from this corner of pixels: that of (x, y) that is nearest to (0, 0)
        Arc arc;
        bool same_is_left;  // of the arc: its surface
        float coc_px, length_px;
        PixelAt middle;  // of the arc
        int around_px;   // columns and rows from there within which it tells what is hidden
    };
    const std::vector<Outline>& outlines() const { return outlines_; }

private:
    void sort_into_cells(int width, int height);

    std::vector<Outline> outlines_;
    int columns_ = 0;
    std::vector<std::vector<int>> near_;  // numbers of outlines that may reach into each cell
};

}  // namespace petzval::engine
