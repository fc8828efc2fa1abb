// Room around a picture for the light that leaves it, where nothing follows.
#include "petzval/shot.h"

#include "shot/file_of_shot.h"
#include "shot/wording.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace petzval {
namespace {

// Colour is empty outside the old window, but depth continues: a depth edge there would count as a
// silhouette.
template <typename T>
Image<T> grown(const Image<T>& old, const Rect& window, const Rect& wider, bool repeat) {
    Image<T> result(wider.width(), wider.height());
    for (int y = wider.y0; y < wider.y1; ++y)
        for (int x = wider.x0; x < wider.x1; ++x)
            if (repeat || window.contains(x, y))
                result(x - wider.x0, y - wider.y0) = old.view().clamped(x - window.x0, y - window.y0);
    return result;
}

// Radii of every pixel by depth or as given, and the largest of its deep samples.
Result<Plane> largest_radii(const Shot& shot, const Look& look) {
    const auto lent = rendered(shot);
    if (!lent) return lent.error();
    auto radii = circle_of_confusion(*lent, look);
    if (!radii || shot.deep.empty()) return radii;
    const auto coc = CircleOfConfusion::make(lent->camera, shot.place.display_window.width(), look.coc);
    if (!coc && !shot.has_radii()) return coc.error();
    for (int y = 0; y < radii->height(); ++y)
        for (int x = 0; x < radii->width(); ++x)
            for (const DeepSample& s : shot.deep.at(x, y)) {
                const float radius =
                    std::abs(shot.has_radii() ? s.depth : float(coc->radius_px(double(s.depth))));
                (*radii)(x, y) = std::max(std::abs((*radii)(x, y)), radius);
            }
    return radii;
}

// On each side that ends inside the display window.
Rect where_empty(const Place& place, const Rect& wider) {
    const Rect &old = place.data_window, &display = place.display_window;
    return {old.x0 > display.x0 ? wider.x0 : old.x0, old.y0 > display.y0 ? wider.y0 : old.y0,
            old.x1 < display.x1 ? wider.x1 : old.x1, old.y1 < display.y1 ? wider.y1 : old.y1};
}

}  // namespace

Result<int> reach_px(const Shot& shot, const Look& look) {
    const auto radii = largest_radii(shot, look);
    if (!radii) return radii.error();
    float largest = 0;
    for (std::size_t i = 0; i < radii->size(); ++i)
        if (shot.colour.pixels()[i] != Rgba{}) largest = std::max(largest, std::abs(radii->pixels()[i]));
    // Distortion moves what the blur has spread.
    const int moved = look.lens.distortion != 0 ? distortion_reach_px(shot.place, look.lens.distortion) : 0;
    return int(std::ceil(double(largest) * std::max(1.0, look.lens.aperture.squeeze))) + 1 + moved;
}

Result<Rect> window_of_light(const Shot& shot, const Look& look, double spread, bool within_frame) {
    constexpr double kFarthest = 1 << 24, kSharp = 0.5;  // a pixel's own square
    const Rect old = shot.place.data_window, &display = shot.place.display_window;
    if (where_empty(shot.place, display) == old) return old;
    const auto radii = largest_radii(shot, look);
    if (!radii) return radii.error();
    const double aspect = shot.place.pixel_aspect, tall = std::max(1.0, look.lens.aperture.squeeze) * aspect;
    double left = 0, top = 0, right = old.width(), bottom = old.height();
    for (int y = 0; y < radii->height(); ++y)
        for (int x = 0; x < radii->width(); ++x) {
            const double r = std::abs(double((*radii)(x, y))) * spread;
            if (shot.colour(x, y) == Rgba{} || !(r > kSharp)) continue;
            const double across = std::min(r, kFarthest) + 1, down = std::min(r * tall, kFarthest) + 1;
            left = std::min(left, x - across), right = std::max(right, x + 1 + across);
            top = std::min(top, y - down), bottom = std::max(bottom, y + 1 + down);
        }
    const int moved = look.lens.distortion != 0 ? distortion_reach_px(shot.place, look.lens.distortion) : 0;
    const Rect lit{old.x0 + int(std::floor(left)) - moved, old.y0 + int(std::floor(top)) - moved,
                   old.x0 + int(std::ceil(right)) + moved, old.y0 + int(std::ceil(bottom)) + moved};
    const Rect frame{std::min(old.x0, display.x0), std::min(old.y0, display.y0), std::max(old.x1, display.x1),
                     std::max(old.y1, display.y1)};
    return where_empty(shot.place, within_frame ? lit.intersected(frame) : lit);
}

Rect with_empty_sides(const Place& place, int by_px) {
    return where_empty(place, place.data_window.grown(by_px));
}

Result<bool> grow_empty_sides(Shot& shot, int by_px) {
    return grow_to(shot, with_empty_sides(shot.place, by_px));
}

Result<bool> grow_to(Shot& shot, const Rect& wider) {
    const Rect old = shot.place.data_window;
    if (wider == old) return false;
    if (shot::is_too_large(wider))
        return Error{ErrorCode::InvalidArgument, "shot.overscan_px would make a picture of " +
                                                     shot::window_text(wider) + "; give fewer pixels"};
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
    shot::extend_mask(shot, wider);
    for (LightPoint& light : shot.lights)
        light.x += float(old.x0 - wider.x0), light.y += float(old.y0 - wider.y0);
    shot.place.data_window = wider;
    shot.has_alpha = true;
    return true;
}

}  // namespace petzval
