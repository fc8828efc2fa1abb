#include "session/windows.h"

#include "session/frame_part.h"
#include "session/rendered/distort.h"
#include "session/rendered/on_grid.h"

#include <algorithm>
#include <cmath>

namespace petzval {
namespace {

int grid_for(float largest_radius_px, const kernel::LensModel& lens) {
    const double reach = lens.reach_px(double(largest_radius_px));
    return petzval::grid_for(largest_radius_px, reach > 1.1 * double(largest_radius_px) + 2);
}

}  // namespace

float largest_radius_px(const FrameRequest& request, const Radii& radii) {
    float largest = 0;
    const auto note = [&](float depth) { largest = std::max(largest, std::abs(radii(depth))); };
    const View<const float> depth = depth_or_radii(request.rendered);
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) note(depth(x, y));
    for (const DeepPicture* deep : {request.rendered.deep, request.rendered.behind})
        if (deep)
            for (const DeepSample& s : deep->samples()) note(s.depth);
    return largest;
}

bool shows_result(const FrameRequest& request) {
    return request.view == ScatterView::Result && request.look.gather.stage == GatherStage::Final &&
           request.look.gaussian.view == GaussianView::Result;
}

Rect window_for(const FrameRequest& request, const Radii& radii, const kernel::LensModel& lens) {
    const bool is_whole = request.rendered.place.data_window == request.rendered.place.display_window;
    if (is_whole || !shows_result(request) || request.look.engine == "reference")
        return request.rendered.place.data_window;
    return on_grid(request.rendered.place.display_window, request.rendered.place.data_window,
                   grid_for(largest_radius_px(request, radii), lens));
}

Rect seen_pixels(const Rect& asked, bool is_region, const FrameRequest& request,
                 const engine::EngineView& view) {
    const Rect all = view.samples.colour.rect();
    if (!is_region) return all;
    // A view shown instead of a result takes its measures from all it sees.
    if (!shows_result(request)) return all;
    const float largest = std::max(-view.samples.nearest_coc_px, view.samples.farthest_coc_px);
    const int margin = region_margin_px(double(largest), view.lens.level(0).reach_px(double(largest)));
    constexpr int kTiles = 128;  // pixels of the largest
    const Rect from = request.look.lens.distortion != 0
                          ? before_distortion(asked, request.rendered.place, request.look.lens.distortion)
                          : asked;
    return pixels_for(from, margin, std::max(kTiles, grid_for(largest, view.lens.level(0))), all);
}

}  // namespace petzval
