#include "petzval/place.h"

#include <cmath>
#include <string>

namespace petzval {

PixelField Place::field() const {
    return {0.5 * (display_window.x0 + display_window.x1) - data_window.x0,
            0.5 * (display_window.y0 + display_window.y1) - data_window.y0,
            2 / std::hypot(display_window.width(), display_height_px()), pixel_aspect};
}

Status check(const Place& place) {
    const auto refuse = [](const std::string& why) { return Error{ErrorCode::InvalidArgument, why}; };
    if (place.display_window.empty()) return refuse("the display window is empty");
    if (place.data_window.empty()) return refuse("the data window is empty");
    if (!(place.pixel_aspect > 0) || !std::isfinite(place.pixel_aspect))
        return refuse("the pixel aspect ratio must be > 0, got " + std::to_string(place.pixel_aspect));
    return Done{};
}

}  // namespace petzval
