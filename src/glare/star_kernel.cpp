#include "glare/star_kernel.h"

#include "base/fft.h"
#include "base/parallel.h"
#include "colour/spectrum.h"
#include "kernel/draw/outline.h"
#include "kernel/model/gamut.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace petzval::glare {
namespace {

constexpr double kStep = 0.5;       // of the pattern's grid, in units of L N; finer would hold nothing more
constexpr double kUsed = 0.85;      // share of the grid that is used: aliases lie beyond
constexpr int kLargestGrid = 4096;  // points a side
constexpr double kReference_nm = 550, kReddest_nm = 700;
constexpr int kBands = 24;
constexpr double kCore_px = 1.5;  // light nearer than about this stays where it was

// |F|^2 for frequencies i >= 0 (rows) and all j (columns, wrapped), of sum 1 over the whole plane.
class Pattern {
public:
    Pattern(const ApertureShape& aperture, int n, Workers& workers);
    // Any i, j with |i|, |j| < n/2; P(-q) = P(q).
    float operator()(int i, int j) const {
        if (i < 0) i = -i, j = -j;
        return half_[std::size_t(i) * std::size_t(n_) + std::size_t(j < 0 ? j + n_ : j)];
    }

private:
    int n_;
    std::vector<float> half_;
};

// The aperture on n/2 x n/2 pixels: a diameter of n kStep.
std::vector<float> drawn(const ApertureShape& aperture, int side) {
    std::vector<kernel::Point> outline = kernel::aperture_outline(aperture, 0.02 / side);
    const double scale = 0.5 * (side - 2);
    for (kernel::Point& p : outline) p = scale * p + kernel::Point{0.5 * (side - 1), 0.5 * (side - 1)};
    kernel::CoverageBuffer<double> buffer({0, 0, side, side});
    buffer.add_polygon(outline, 1.0);
    std::vector<float> pixels;
    pixels.reserve(std::size_t(side) * std::size_t(side));
    for (int y = 0; y < side; ++y) {
        const double* row = buffer.resolve_row(y);
        for (int x = 0; x < side; ++x) pixels.push_back(float(row[x]));
    }
    return pixels;
}

Pattern::Pattern(const ApertureShape& aperture, int n, Workers& workers)
    : n_(n), half_(std::size_t(n) * std::size_t(n / 2 + kLanes)) {
    const int side = int(n * kStep);
    const std::vector<float> image = drawn(aperture, side);
    const Fft fft(n);
    // Rows first, of which only the frequencies i >= 0 are kept: the image is real. [i][y]
    const int kept = n / 2 + kLanes;  // one more than n/2, in whole groups
    std::vector<std::complex<float>> columns(std::size_t(kept) * std::size_t(side));
    const std::size_t lanes = kLanes, points = std::size_t(n);
    parallel_for(side / kLanes, workers, [&](int group) {
        std::vector<float> re(points * lanes), im(points * lanes);
        const std::size_t first = std::size_t(group) * lanes;
        for (std::size_t x = 0; x < std::size_t(side); ++x)
            for (std::size_t l = 0; l < lanes; ++l)
                re[x * lanes + l] = image[(first + l) * std::size_t(side) + x];
        fft.transform(re.data(), im.data(), false);
        for (std::size_t i = 0; i < std::size_t(kept); ++i)
            for (std::size_t l = 0; l < lanes; ++l)
                columns[i * std::size_t(side) + first + l] = {re[i * lanes + l], im[i * lanes + l]};
    });
    double total = 0;
    for (const float v : image) total += double(v) * double(v);
    const float scale = float(1 / (total * double(n) * double(n)));  // Parseval
    parallel_for(kept / kLanes, workers, [&](int group) {
        std::vector<float> re(points * lanes), im(points * lanes);
        const std::size_t first = std::size_t(group) * lanes;
        for (std::size_t y = 0; y < std::size_t(side); ++y)
            for (std::size_t l = 0; l < lanes; ++l) {
                re[y * lanes + l] = columns[(first + l) * std::size_t(side) + y].real();
                im[y * lanes + l] = columns[(first + l) * std::size_t(side) + y].imag();
            }
        fft.transform(re.data(), im.data(), false);
        for (std::size_t j = 0; j < points; ++j)
            for (std::size_t l = 0; l < lanes; ++l) {
                const float a = re[j * lanes + l], b = im[j * lanes + l];
                half_[(first + l) * points + j] = scale * (a * a + b * b);
            }
    });
}

// The cells of the pattern's grid that one pixel covers, and how much of each.
struct Footprint {
    int first = 0;
    std::vector<float> share;
};

Footprint footprint(int pixel, double cells_per_px) {
    const double low = (pixel - 0.5) * cells_per_px + 0.5, high = (pixel + 0.5) * cells_per_px + 0.5;
    Footprint f{int(std::floor(low)), {}};
    for (int i = f.first; i < high; ++i)
        f.share.push_back(float(std::min(high, i + 1.0) - std::max(low, double(i))));
    return f;
}

struct Geometry {
    int reach = 0, reach_y = 0;  // px
    int n = 0;                   // points of the grid
    double reddest_px = 0;       // 700 nm times N, px
    double reach_cells = 0;      // where the pattern ends, in cells
    double pixel_aspect = 1;
};

Geometry geometry(double radius_px, double diffraction_px, double pixel_aspect) {
    Geometry g;
    g.reddest_px = reddest_px(radius_px, diffraction_px);
    g.reach_cells = radius_px / g.reddest_px / kStep;
    for (g.n = 64; kUsed * g.n / 2 < g.reach_cells; g.n *= 2) {
    }
    g.reach = int(std::ceil(radius_px)), g.reach_y = int(std::ceil(radius_px * pixel_aspect));
    g.pixel_aspect = pixel_aspect;
    return g;
}

// Adds one band to the kernel's half x >= 0.
void add_band(const Pattern& pattern, const Geometry& g, const colour::SpectralBand& band,
              kernel::PointSpread& star, Workers& workers) {
    const double cells_per_px = kReddest_nm / (g.reddest_px * band.wavelength_nm * kStep);
    const int limit = int(g.reach_cells) + 1;  // cells from the middle
    std::vector<Footprint> rows;
    for (int y = -g.reach_y; y <= g.reach_y; ++y) rows.push_back(footprint(y, cells_per_px / g.pixel_aspect));
    parallel_for(g.reach + 1, workers, [&](int x) {
        const Footprint columns = footprint(x, cells_per_px);
        if (columns.first > limit) return;
        std::vector<float> strip(
            std::size_t(2 * limit + 1));  // the pattern summed over this column of pixels
        for (std::size_t k = 0; k < columns.share.size(); ++k) {
            const int i = columns.first + int(k);
            if (i > limit) break;
            for (int j = -limit; j <= limit; ++j)
                strip[std::size_t(j + limit)] += columns.share[k] * pattern(i, j);
        }
        for (int y = -g.reach_y; y <= g.reach_y; ++y) {
            const double along = std::hypot(double(x), y / g.pixel_aspect);
            const double end = along * cells_per_px / g.reach_cells;
            if (end >= 1) continue;
            const Footprint& f = rows[std::size_t(y + g.reach_y)];
            float sum = 0;
            for (std::size_t k = 0; k < f.share.size(); ++k)
                if (const int j = f.first + int(k); std::abs(j) <= limit)
                    sum += f.share[k] * strip[std::size_t(j + limit)];
            const double fade = (1 - end * end) * (1 - end * end);
            const double outside_core = 1 - std::exp(-along * along / (kCore_px * kCore_px));
            const float light = float(fade * outside_core) * sum;
            star.weights(x + g.reach, y + g.reach_y) +=
                light * Rgba{float(band.r), float(band.g), float(band.b), 0};
        }
    });
}

}  // namespace

double reddest_px(double radius_px, double diffraction_px) {
    const double finest = radius_px / (kUsed * kLargestGrid / 2 * kStep);
    return std::max(finest, diffraction_px * kReddest_nm / kReference_nm);
}

kernel::PointSpread star_kernel(const ApertureShape& aperture, double radius_px, double diffraction_px,
                                double pixel_aspect, Workers& workers) {
    const Geometry g = geometry(radius_px, diffraction_px, pixel_aspect);
    const Pattern pattern(aperture, g.n, workers);
    kernel::PointSpread star;
    star.extent = {-g.reach, -g.reach_y, g.reach + 1, g.reach_y + 1};
    star.weights = Picture(star.extent.width(), star.extent.height());
    star.neutral = false;
    for (const colour::SpectralBand& band : colour::spectral_bands(kBands))
        add_band(pattern, g, band, star, workers);
    const std::size_t last = star.weights.size() - 1;  // the other half: P(-x) = P(x)
    for (int y = 0; y < star.weights.height(); ++y)
        for (int x = g.reach; x < star.weights.width(); ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(star.weights.width()) + std::size_t(x);
            star.weights.pixels()[last - i] = star.weights.pixels()[i];
        }
    kernel::map_into_gamut(star);
    kernel::normalise(star);
    return star;
}

}  // namespace petzval::glare
