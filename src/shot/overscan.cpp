// Room around a picture for the light that leaves it, where nothing follows.
#include "petzval/shot.h"

#include "shot/file_of_shot.h"
#include "shot/wording.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace petzval {
namespace {

// Colour is emptiness outside of the old window, depth goes on: a silhouette there would be taken for a real
// one.
template <typename T>
Image<T> grown(const Image<T>& old, const Rect& window, const Rect& wider, bool repeat) {
    Image<T> result(wider.width(), wider.height());
    for (int y = wider.y0; y < wider.y1; ++y)
        for (int x = wider.x0; x < wider.x1; ++x)
            if (repeat || window.contains(x, y))
                result(x - wider.x0, y - wider.y0) = old.view().clamped(x - window.x0, y - window.y0);
    return result;
}

}  // namespace

Result<int> reach_px(const Shot& shot, const Look& look) {
    auto job = rendered(shot);
    if (!job) return job.error();
    const auto radii = circle_of_confusion(with_look(*job, look));
    if (!radii) return radii.error();
    float largest = 0;
    for (std::size_t i = 0; i < radii->size(); ++i)
        if (shot.colour.pixels()[i] != Rgba{}) largest = std::max(largest, std::abs(radii->pixels()[i]));
    // Distortion moves what the blur has spread.
    const int moved = look.lens.distortion != 0 ? distortion_reach_px(shot.place, look.lens.distortion) : 0;
    return int(std::ceil(double(largest) * std::max(1.0, look.lens.aperture.squeeze))) + 1 + moved;
}

Result<bool> grow_empty_sides(Shot& shot, int by_px) {
    const Rect old = shot.place.data_window, &display = shot.place.display_window;
    const Rect wider{
        old.x0 > display.x0 ? old.x0 - by_px : old.x0, old.y0 > display.y0 ? old.y0 - by_px : old.y0,
        old.x1 < display.x1 ? old.x1 + by_px : old.x1, old.y1 < display.y1 ? old.y1 + by_px : old.y1};
    if (wider == old) return false;
    if (shot::is_too_large(wider))
        return Error{ErrorCode::InvalidArgument, "shot.overscan_px " + std::to_string(by_px) +
                                                     " would make a picture of " + shot::window_text(wider) +
                                                     "; give fewer pixels"};
    shot.colour = grown(shot.colour, old, wider, false);
    for (FrameLayer& layer : shot.layers) layer.colour = grown(layer.colour, old, wider, false);
    std::visit(
        [&](auto& depth) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(depth)>, std::monostate>)
                depth.plane = grown(depth.plane, old, wider, true);
        },
        shot.depth);
    for (DeepPicture* deep : {&shot.deep, &shot.behind, &shot.holdout})
        if (!deep->empty()) *deep = merge_deep({{deep, old}}, wider);
    for (LightPoint& light : shot.lights)
        light.x += float(old.x0 - wider.x0), light.y += float(old.y0 - wider.y0);
    shot.place.data_window = wider;
    shot.has_alpha = true;
    return true;
}

}  // namespace petzval
