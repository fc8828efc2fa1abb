#include "engine/samples/silhouettes/connectivity.h"

#include "base/parallel.h"

#include <cmath>

namespace petzval::engine {
namespace {

// True if the step of the radius between two pixels is one of rounded depths: on this side, it recurs after
// any number of equal pixels. step(n): n pixels away. (Larger steps may be cards, one behind the other.)
bool is_rounded(const auto& step, int side) {
    constexpr int kEqualPx = 64;
    const float own = step(0);
    if (std::abs(own) > 3 * completion_model.step_px) return false;
    for (int n = 1; n <= kEqualPx; ++n)
        if (const float next = step(side * n); next != 0)
            return std::abs(next - own) <= 0.01f * std::abs(own);
    return false;
}

}  // namespace

Image<unsigned char> connections(View<const float> coc, Workers& workers) {
    const int width = coc.width(), height = coc.height();
    Image<unsigned char> connected(width, height, kAll);
    const float least_px = completion_model.between_px();
    const auto joined = [&](int x, int y, int dx, int dy) {
        const auto step = [&](int n) {
            return coc.clamped(x + (n + 1) * dx, y + (n + 1) * dy) - coc.clamped(x + n * dx, y + n * dy);
        };
        return continues_slope(step(0), step(-1), step(-2)) || continues_slope(step(0), step(1), step(2)) ||
               is_rounded(step, 1) || is_rounded(step, -1);
    };
    // Each row is written by one thread; both rows of a pair decide about it.
    parallel_for(height, workers, [&](int y) {
        const float* const own = coc.row(y);
        unsigned char* const out = connected.row(y);
        const auto cut = [out](int x, Connected side) {
            out[x] = static_cast<unsigned char>(out[x] & ~side);
        };
        for (int x = 0; x + 1 < width; ++x)
            if (!(std::abs(own[x + 1] - own[x]) <= least_px) && !joined(x, y, 1, 0))
                cut(x, kRight), cut(x + 1, kLeft);
        const auto cut_from = [&](int above, Connected side) {
            if (above < 0 || above + 1 >= height) return;
            const float *const upper = coc.row(above), *const lower = coc.row(above + 1);
            for (int x = 0; x < width; ++x)
                if (!(std::abs(lower[x] - upper[x]) <= least_px) && !joined(x, above, 0, 1)) cut(x, side);
        };
        cut_from(y, kDown), cut_from(y - 1, kUp);
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
