#include "first_look.h"

#include "thinning.h"

#include <algorithm>
#include <cmath>

namespace petzval::view {

int thinning_of(const Wish& wish) {
    constexpr double kFirstPixels = 4e5;
    const double pixels = double(wish.shot->shot.colour.size());
    // Discs keep their shape while a scene's camera moves: its blur has at least every other pixel, its rays
    // fewer.
    constexpr int kCoarsestBlur = 2;
    return std::max({std::min(wish.shot->coarse, kCoarsestBlur), wish.coarse,
                     int(std::ceil(std::sqrt(pixels / kFirstPixels)))});
}

Result<DefocusReport> first_look(Session& session, const Rendered& rendered, Look look, int by,
                                 const Control& control) {
    Rendered few;
    few.camera = rendered.camera;
    const Picture colour = thinned(rendered.colour, by);
    Plane depth = thinned(depth_or_radii(rendered), by);
    for (std::size_t i = 0; i < depth.size() && has_radii(rendered); ++i) depth.pixels()[i] /= float(by);
    few.colour = colour;
    few.depth = rendered.depth;
    set_depth(few, depth);
    const Rect &frame = rendered.place.display_window, &data = rendered.place.data_window;
    const int x = (data.x0 - frame.x0) / by, y = (data.y0 - frame.y0) / by;
    few.place = {{0, 0, std::max(1, frame.width() / by), std::max(1, frame.height() / by)},
                 Rect{x, y, x + colour.width(), y + colour.height()},
                 rendered.place.pixel_aspect};
    look.coc.max_radius_px /= by;
    Control of_few = control;
    if (of_few.codes) of_few.codes->window = few.place.data_window;
    auto done = session.take(few, look, of_few);
    if (done && done->codes.empty())
        done->image = enlarged<Rgba>(done->image, by, rendered.colour.width(), rendered.colour.height());
    return done;
}

}  // namespace petzval::view
