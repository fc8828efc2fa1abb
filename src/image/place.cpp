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
    constexpr int kFarthest = 1 << 29;  // so that sizes and sums of corners are whole numbers of 32 bits
    for (const Rect& window : {place.display_window, place.data_window})
        for (const int corner : {window.x0, window.y0, window.x1, window.y1})
            if (corner < -kFarthest || corner > kFarthest)
                return refuse("windows lie within 536870912 pixels of 0,0, not at " + std::to_string(corner));
    constexpr float kLeastAspect = 1e-6f, kMostAspect = 1e6f;  // as in EXR files
    if (!(place.pixel_aspect >= double(kLeastAspect) && place.pixel_aspect <= double(kMostAspect)))
        return refuse("the pixel aspect ratio must be from 0.000001 to 1000000, got " +
                      std::to_string(place.pixel_aspect));
    return Done{};
}

}  // namespace petzval
