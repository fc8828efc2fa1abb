// The start of a data window decides nothing: engines see a picture that stands on the grid of its display
// window.
//
// Engines work in tiles, cells and blocks that stand on the first pixel they are given. A data window that
// follows its contents from frame to frame (autocrop) would shift all of them, and the picture would flicker.
#pragma once

#include "petzval/rendered.h"

#include <algorithm>
#include <vector>

namespace petzval {

// The data window grown to the left and up, so that it begins a whole number of `grid` pixels from the first
// column and row of the display window.
Rect on_grid(const Rect& display_window, const Rect& data_window, int grid);

// The pixels of the coarsest grid that any engine uses for radii up to this; a power of two. spreads_wider:
// the lens's discs are wider than their radius, and their rims come on coarser grids.
int grid_for(float largest_radius_px, bool spreads_wider);

// A frame with a wider data window: emptiness beyond edges that lie inside the display window; beyond others
// the scene continues as its border does, without what is brighter there than its surroundings.
class WiderFrame {
public:
    // Requires: window holds asked.place.data_window; `asked` outlives this.
    WiderFrame(const Rendered& asked, const Rect& window);
    WiderFrame(const WiderFrame&) = delete;
    WiderFrame& operator=(const WiderFrame&) = delete;
    const Rendered& rendered() const { return wider_; }

private:
    void widen_colour(const Rendered& asked);
    Picture widened(View<const Rgba> picture) const;
    DeepPicture widened(const DeepPicture& deep, bool is_matte) const;
    int column(int x) const { return std::clamp(x - inside_.x0, 0, inside_.width() - 1); }
    int row(int y) const { return std::clamp(y - inside_.y0, 0, inside_.height() - 1); }

    Rect inside_;  // what was asked for, in pixels of the wider picture
    Rendered wider_;
    Picture colour_;
    std::vector<Picture> layers_;
    Plane depth_, kept_;  // kept_: the share of a repeated pixel's light that stays outside; 0: emptiness
    DeepPicture deep_, behind_, holdout_;
    std::vector<LightPoint> lights_;
};

}  // namespace petzval
