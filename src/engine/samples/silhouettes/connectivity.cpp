#include "engine/samples/silhouettes/connectivity.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace petzval::engine {
namespace {

constexpr float kNoStep = 1e30f;

// The smallest step that a line of pixels takes twice in succession, with any number of equal pixels between.
struct Stairs {
    float last = 0, least = kNoStep;
    void add(float step) {
        if (step == 0) return;
        if (std::abs(step - last) <= 0.01f * std::abs(step)) least = std::min(least, std::abs(step));
        last = step;
    }
};

// The step of depths that have few bits; next to nothing if they have many.
float quantum_px(View<const float> coc, Workers& workers) {
    constexpr int kColumns = 64;
    const int width = coc.width(), height = coc.height(), strips = (width + kColumns - 1) / kColumns;
    std::vector<float> found(std::size_t(height + strips), kNoStep);
    parallel_for(height, workers, [&](int y) {
        Stairs row;
        for (int x = 0; x + 1 < width; ++x) row.add(coc(x + 1, y) - coc(x, y));
        found[std::size_t(y)] = row.least;
    });
    parallel_for(strips, workers, [&](int i) {
        std::array<Stairs, kColumns> columns;
        const int x0 = i * kColumns, count = std::min(kColumns, width - x0);
        for (int y = 0; y + 1 < height; ++y)
            for (int n = 0; n < count; ++n) columns[std::size_t(n)].add(coc(x0 + n, y + 1) - coc(x0 + n, y));
        for (const Stairs& column : columns)
            found[std::size_t(height + i)] = std::min(found[std::size_t(height + i)], column.least);
    });
    return found.empty() ? kNoStep : *std::min_element(found.begin(), found.end());
}

// A narrower step always connects, because it hides almost nothing or is one of rounded depths. (Larger ones
// may be cards, one behind the other.)
float least_step_px(View<const float> coc, Workers& workers) {
    const CompletionModel& model = completion_model;
    const float rounded_px = 1.25f * quantum_px(coc, workers);
    return rounded_px > 3 * model.step_px ? model.between_px() : std::max(rounded_px, model.between_px());
}

}  // namespace

Image<unsigned char> connections(View<const float> coc, Workers& workers) {
    const int width = coc.width(), height = coc.height();
    Image<unsigned char> connected(width, height, kAll);
    const float least_px = least_step_px(coc, workers);
    const auto joined = [&](int x, int y, int dx, int dy) {
        const auto step = [&](int n) {
            return coc.clamped(x + (n + 1) * dx, y + (n + 1) * dy) - coc.clamped(x + n * dx, y + n * dy);
        };
        return continues_slope(step(0), step(-1), step(-2)) || continues_slope(step(0), step(1), step(2));
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
