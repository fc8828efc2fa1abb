#include "device/cpu/glare/convolve.h"

#include "base/fft.h"
#include "base/parallel.h"

#include <algorithm>
#include <vector>

namespace petzval::device {

using glare::Filter;

namespace {

using Field = std::vector<std::complex<float>>;

// Two real pictures travel as one complex one, a + i b. With X its transform, that of a is (X(k) + X*(-k))/2
// and that of i b is (X(k) - X*(-k))/2, so a filtered by A and b by B together become
// (A + B)/2 X(k) + (A - B)/2 X*(-k).
void filter_pair(Field& field, const std::vector<float>& a, const std::vector<float>& b, int n,
                 Workers& workers) {
    const std::size_t points = std::size_t(n);
    parallel_for(n / 2 + 1, workers, [&](int row) {
        const std::size_t y = std::size_t(row), opposite = (points - y) % points;
        for (std::size_t x = 0; x < points; ++x) {
            const std::size_t here = y * points + x, there = opposite * points + (points - x) % points;
            if (here > there && y == opposite) continue;  // was done as the other's opposite
            const std::complex<float> p = field[here], q = field[there];
            const float sum = 0.5f * (a[here] + b[here]), difference = 0.5f * (a[here] - b[here]);
            field[here] = sum * p + difference * std::conj(q);
            field[there] = sum * q + difference * std::conj(p);  // the kernel's transform is symmetric too
        }
    });
}

bool is_dark(View<const Rgba> tile) {
    for (int y = 0; y < tile.height(); ++y)
        for (int x = 0; x < tile.width(); ++x) {
            const Rgba c = tile(x, y);
            if (c.r != 0 || c.g != 0 || c.b != 0) return false;
        }
    return true;
}

}  // namespace

void add_convolved(View<Rgba> out, View<const Rgba> light, const Filter& filter, float amount,
                   Workers& workers) {
    const int reach = filter.reach, n = filter.size, tile = n - 2 * reach;
    const Fft fft(n);
    const auto at = [&](int x, int y) { return std::size_t(y) * std::size_t(n) + std::size_t(x); };
    for (int y0 = 0; y0 < light.height(); y0 += tile)
        for (int x0 = 0; x0 < light.width(); x0 += tile) {
            const Rect rect = Rect{x0, y0, x0 + tile, y0 + tile}.intersected(light.rect());
            const View<const Rgba> source = light.part(rect);
            if (is_dark(source)) continue;
            Field red_green(std::size_t(n) * std::size_t(n)), blue(red_green.size());
            for (int y = 0; y < source.height(); ++y)
                for (int x = 0; x < source.width(); ++x) {
                    const Rgba c = source(x, y);
                    red_green[at(x + reach, y + reach)] = {c.r, c.g};
                    blue[at(x + reach, y + reach)] = c.b;
                }
            for (Field* field : {&red_green, &blue}) fft_square(*field, fft, false, workers);
            filter_pair(red_green, filter.r, filter.g, n, workers);
            for (std::size_t i = 0; i < blue.size(); ++i) blue[i] *= filter.b[i];
            for (Field* field : {&red_green, &blue}) fft_square(*field, fft, true, workers);
            const Rect lit = rect.grown(reach).intersected(out.rect());
            for (int y = lit.y0; y < lit.y1; ++y)
                for (int x = lit.x0; x < lit.x1; ++x) {
                    const std::size_t i = at(x - x0 + reach, y - y0 + reach);
                    // Rounding of the transforms lies about zero; light is not negative.
                    const auto positive = [](float v) { return std::max(v, 0.0f); };
                    out(x, y) += amount * Rgba{positive(red_green[i].real()), positive(red_green[i].imag()),
                                               positive(blue[i].real()), 0};
                }
        }
}

}  // namespace petzval::device
