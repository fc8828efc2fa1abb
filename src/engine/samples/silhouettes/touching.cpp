#include "engine/samples/silhouettes/touching.h"

#include "base/parallel.h"
#include "engine/samples/silhouettes/connectivity.h"

namespace petzval::engine {
namespace {

bool touches_silhouette(View<const unsigned char> connected, int x, int y) {
    const auto at = [&](int u, int v) {
        return connected.rect().contains(u, v) ? int(connected(u, v)) : int(kAll);
    };
    // Diagonal: a side neighbour is cut from the diagonal pixel.
    constexpr int kVertical = kUp | kDown, kHorizontal = kLeft | kRight;
    return connected(x, y) != kAll || (at(x - 1, y) & at(x + 1, y) & kVertical) != kVertical ||
           (at(x, y - 1) & at(x, y + 1) & kHorizontal) != kHorizontal;
}

// The same as touches_silhouette(), for a whole row at once; most pixels touch no silhouette.
void find_touching(View<const unsigned char> connected, int y, View<unsigned char> touching) {
    const int width = connected.width();
    if (y == 0 || y + 1 == connected.height() || width < 3) {
        for (int x = 0; x < width; ++x) touching(x, y) = touches_silhouette(connected, x, y);
        return;
    }
    touching(0, y) = touches_silhouette(connected, 0, y);
    touching(width - 1, y) = touches_silhouette(connected, width - 1, y);
    const unsigned char *above = connected.row(y - 1), *own = connected.row(y), *below = connected.row(y + 1);
    unsigned char* const out = touching.row(y);
    for (int x = 1; x + 1 < width; ++x) {
        const unsigned beside = own[x - 1] & own[x + 1] & (kUp | kDown);
        const unsigned over = above[x] & below[x] & (kLeft | kRight);
        out[x] = (own[x] & (beside | over)) != kAll;
    }
}

// True if lamps light the pixel or one beside it: less light of theirs than makes a lamp may fall on it.
bool lit_around(const LitPicture& picture, int x, int y) {
    if (!picture.dim_of) return false;
    const Rect window = Rect{x - 1, y - 1, x + 2, y + 2}.intersected(picture.colour.rect());
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u)
            if (picture.dim(u, v) != picture.colour(u, v)) return true;
    return false;
}

}  // namespace

Image<unsigned char> touching_silhouettes(const LitPicture& picture, View<const unsigned char> connected,
                                          Workers& workers) {
    const int width = connected.width(), height = connected.height();
    auto touching = Image<unsigned char>::uninitialised(width, height);
    parallel_for(height, workers, [&](int y) {
        find_touching(connected, y, touching);
        for (int x = 0; x < width; ++x)
            if (touching(x, y) && lit_around(picture, x, y)) touching(x, y) |= kLit;
    });
    return touching;
}

}  // namespace petzval::engine
