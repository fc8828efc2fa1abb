// Grids of cells over a picture: on level n they are 2^n pixels wide, the first begins with pixel 0.
#pragma once

#include "petzval/image.h"

namespace petzval::engine {

// The cells of a level that hold these pixels, with as many around them as enlarging to pixels reads. On
// level 0, where nothing is enlarged, the pixels alone.
inline Rect cells_of(const Rect& pixels, int level, int border) {
    if (level == 0) return pixels;
    return Rect{pixels.x0 >> level, pixels.y0 >> level, ((pixels.x1 - 1) >> level) + 1,
                ((pixels.y1 - 1) >> level) + 1}
        .grown(border);
}

}  // namespace petzval::engine
