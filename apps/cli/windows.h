// Pixels of one window seen through another.
#pragma once

#include "petzval/image.h"

namespace petzval::cli {

// The pixels that cover `data`, as `window` shows them; `fill` where there are none. Both windows are in
// pixels of the same frame.
template <typename T>
Image<T> through_window(const Image<T>& pixels, const Rect& data, const Rect& window, T fill) {
    Image<T> seen(window.width(), window.height(), fill);
    const Rect shared = data.intersected(window);
    for (int y = shared.y0; y < shared.y1; ++y)
        for (int x = shared.x0; x < shared.x1; ++x)
            seen(x - window.x0, y - window.y0) = pixels(x - data.x0, y - data.y0);
    return seen;
}

}  // namespace petzval::cli
