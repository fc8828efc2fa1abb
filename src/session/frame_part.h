// Part of a frame, as an engine is to see it so that it draws the same bits there.
#pragma once

#include "petzval/defocus.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include "engine/waist/engine.h"

#include <optional>
#include <vector>

namespace petzval {

// Pixels around a region that engines look at: what spreads there, what hides that, what filling looks at
// behind it, and the neighbourhoods in which lights are told from surfaces. reach_px: of the light of the
// largest radius.
int region_margin_px(double largest_radius_px, double reach_px);

// The pixels of a frame of that size to be seen for `region` of it: with the margin, from and to whole
// multiples of `grid`, on which engines have their tiles and cells.
Rect pixels_for(const Rect& region, int margin_px, int grid, const Rect& frame);

// Errors: InvalidArgument for a region without any pixel of the picture, or of what is not one.
Status check_region(const Rect& region, const DefocusJob& job);

// Of a job's pictures, those that a report of `region` of it holds; of all where there is none.
Rect made_pixels(const DefocusJob& job, const std::optional<Rect>& region);

Picture part_of(const Picture& image, const Rect& pixels);

class FramePart {
public:
    // Of a view that is whole and outlives this.
    FramePart(const engine::EngineView& whole, const Rect& pixels);
    FramePart(const FramePart&) = delete;
    FramePart& operator=(const FramePart&) = delete;
    const engine::EngineView& view() const { return view_; }

private:
    engine::CocSamples deep_, holdout_;
    std::vector<LightPoint> points_;
    engine::EngineView view_;
};

}  // namespace petzval
