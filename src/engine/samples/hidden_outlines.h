// Outlines of surfaces that something nearer hides: where one is hidden, it goes on as it came.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include <vector>

namespace petzval::engine {

// Found from radii alone: where three surfaces meet in a picture, the nearest hides how the outline of the
// middle one, before the farthest, goes on. It is traced from there, and goes on straight behind what hides
// it, up to where that ends.
class HiddenOutlines {
public:
    HiddenOutlines() = default;
    // coc_px: of each pixel, as the picture states it.
    HiddenOutlines(View<const float> coc_px, Workers& workers);

    struct Point {
        int x, y;
    };
    // Whether a surface at coc_px that shows at `shown` goes on to a hidden point: 1, or 0 beyond its own
    // outline.
    float within(Point shown, Point hidden, float coc_px) const;
    // Whether it can be what is to be seen there: 0 where the outline of a nearer surface begins between
    // them.
    float unhidden(Point shown, Point hidden, float coc_px) const;

    struct Outline {
        Point at;              // a corner of pixels: that of (x, y) that is nearest to (0, 0)
        float off_x, off_y;    // from there to where it is hidden
        float into_x, into_y;  // where it goes on; of length 1
        float side;            // 1 or -1: on which side of that its surface lies
        float coc_px, length_px;
        Point middle;   // of where it goes on
        int around_px;  // columns and rows from there within which it tells what is hidden
    };
    const std::vector<Outline>& outlines() const { return outlines_; }

private:
    void sort_into_cells(int width, int height);
    // How much of a path from side `from` to the other is open, over the outlines that `concerns` picks.
    template <typename Concerns>
    float open(Point shown, Point hidden, float from, const Concerns& concerns) const;

    std::vector<Outline> outlines_;
    int columns_ = 0;
    std::vector<std::vector<int>> near_;  // numbers of outlines that may reach into each cell
};

}  // namespace petzval::engine
