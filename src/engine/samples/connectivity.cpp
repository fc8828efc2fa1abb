#include "engine/samples/connectivity.h"

#include "base/parallel.h"

#include <algorithm>

namespace petzval::engine {

Image<unsigned char> connections(View<const float> coc, Workers& workers) {
    const int width = coc.width(), height = coc.height();
    Image<unsigned char> connected(width, height, kAll);
    // Each pixel decides about its right and lower side; both pixels of the pair are marked. Rows are done in
    // two sweeps so that no two threads write one row.
    const auto joined = [&](int x, int y, int dx, int dy) {
        const float a = coc(x, y), b = coc(x + dx, y + dy);
        return always_connected(a, b) ||
               same_surface(a, b, a - coc.clamped(x - dx, y - dy), coc.clamped(x + 2 * dx, y + 2 * dy) - b);
    };
    parallel_for(height, workers, [&](int y) {
        for (int x = 0; x + 1 < width; ++x)
            if (!joined(x, y, 1, 0)) {
                connected(x, y) = static_cast<unsigned char>(connected(x, y) & ~kRight);
                connected(x + 1, y) = static_cast<unsigned char>(connected(x + 1, y) & ~kLeft);
            }
        for (int x = 0; x < width; ++x) {
            if (y + 1 < height && !joined(x, y, 0, 1))
                connected(x, y) = static_cast<unsigned char>(connected(x, y) & ~kDown);
            if (y > 0 && !joined(x, y - 1, 0, 1))
                connected(x, y) = static_cast<unsigned char>(connected(x, y) & ~kUp);
        }
    });
    return connected;
}

Slope slope_at(View<const float> coc, View<const unsigned char> connected, int x, int y) {
    const auto along = [&](bool back, bool forth, int dx, int dy) {
        float sum = 0;
        int n = 0;
        if (back) sum += coc(x, y) - coc(x - dx, y - dy), ++n;
        if (forth) sum += coc(x + dx, y + dy) - coc(x, y), ++n;
        return n ? sum / float(n) : 0.0f;
    };
    const unsigned char c = connected(x, y);
    return {along(x > 0 && (c & kLeft), x + 1 < coc.width() && (c & kRight), 1, 0),
            along(y > 0 && (c & kUp), y + 1 < coc.height() && (c & kDown), 0, 1)};
}

}  // namespace petzval::engine
