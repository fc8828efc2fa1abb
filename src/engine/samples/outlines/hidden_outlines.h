// Outlines that an occluder hides: each continues along its visible course.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/outlines/outline_end.h"

#include <limits>
#include <vector>

namespace petzval::engine {

// Pixels farther away than this, in px, never change an answer.
constexpr int kOutlineReachPx = 160;

// Outlines are found from radii alone. Where three surfaces meet in a picture, the nearest hides the
// continuation of the outline between the middle and the farthest one. Two ends on one line or arc are one
// outline, hidden between them ("relatable": P. Kellman, T. Shipley, "A theory of visual interpolation in
// object perception", 1991). A single end continues its course, bent no longer than its visible part, until
// the occluder ends.
class HiddenOutlines {
public:
    HiddenOutlines() = default;
    // coc_px: radius of each pixel, as the picture states it.
    HiddenOutlines(View<const float> coc_px, Workers& workers);

    // For a surface at coc_px visible somewhere: whether it continues to a hidden point, 1, or 0 beyond its
    // own outline; and whether it can be visible there, 0 if the outline of a nearer surface begins between
    // them.
    struct Open {
        float within = 1, unhidden = 1;
    };
    // The outlines that may be hidden near a point. Borrows them.
    class Around;
    Around around(PixelAt hidden) const;

    struct Outline {
        PixelAt at;  // origin of the arc's coordinates: the corner of pixel (x, y) nearest to (0, 0)
        Arc arc;
        bool same_is_left;  // true if the outline's own surface lies to the left of the arc
        float coc_px, length_px;
        PixelAt middle;  // middle of the arc
        int around_px;   // columns and rows from there within which the outline decides
    };
    const std::vector<Outline>& outlines() const { return outlines_; }

private:
    void sort_into_cells(int width, int height);

    std::vector<Outline> outlines_;
    int columns_ = 0;
    std::vector<std::vector<int>> near_;  // numbers of outlines that may reach into each cell
};

class HiddenOutlines::Around {
public:
    Open open(PixelAt shown, float coc_px) const;
    // About how far the hidden point is from the nearest of them; infinite if there is none.
    float distance_px() const { return distance_px_; }

private:
    friend class HiddenOutlines;
    struct Near {
        const Outline* outline;
        PlanePoint to;   // the hidden point, in the coordinates of the outline
        float right_px;  // Arc::right_of() it
    };
    std::vector<Near> near_;
    float distance_px_ = std::numeric_limits<float>::infinity();
};

}  // namespace petzval::engine
