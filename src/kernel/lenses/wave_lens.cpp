#include "kernel/lenses/wave_lens.h"

#include "base/cancel.h"
#include "base/fft.h"
#include "base/parallel.h"
#include "colour/spectrum.h"
#include "kernel/model/gamut.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace petzval::kernel {
namespace {

using Wave = std::vector<std::complex<float>>;  // a square of samples, (0, 0) first, negative places last

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kShortest_nm = 400, kLongest_nm = 700;
// Diffraction is followed this many wavelength x N beyond the rays: 99 % of the light of a round focus.
constexpr double kTail = 20, kLongestTailPx = 48;

// The wavefront without pure defocus, on a grid over the square around the pupil, in pixels x pupil radii.
// Few nodes are integrated; cubic lines (E. Catmull, R. Rom, 1974) through them give a grid fine enough for
// linear interpolation.
class Wavefront {
public:
    Wavefront(const std::function<Point(Point)>& landing, double coc_radius_px, double pixel_aspect) {
        std::vector<double> coarse(std::size_t(kNodes * kNodes));
        for (int j = 0; j < kNodes; ++j)
            for (int i = 0; i < kNodes; ++i)
                coarse[std::size_t(j * kNodes + i)] =
                    integral({place(i), place(j)}, landing, coc_radius_px, pixel_aspect);
        std::vector<double> wide(std::size_t(kNodes * kSide));  // refined along x
        for (int j = 0; j < kNodes; ++j)
            refine(&coarse[std::size_t(j * kNodes)], 1, &wide[std::size_t(j * kSide)], 1);
        values_.resize(std::size_t(kSide * kSide));
        for (int i = 0; i < kSide; ++i) refine(&wide[std::size_t(i)], kSide, &values_[std::size_t(i)], kSide);
    }
    double at(Point u) const {
        const double x = (u.x / kHalf + 1) * 0.5 * (kSide - 1), y = (u.y / kHalf + 1) * 0.5 * (kSide - 1);
        const int i = std::clamp(int(x), 0, kSide - 2), j = std::clamp(int(y), 0, kSide - 2);
        const double s = x - i, t = y - j;
        const double* v = &values_[std::size_t(j * kSide + i)];
        return (1 - t) * ((1 - s) * v[0] + s * v[1]) + t * ((1 - s) * v[kSide] + s * v[kSide + 1]);
    }

private:
    static constexpr int kNodes = 57, kFiner = 3;  // the outermost nodes only bend the lines
    static constexpr int kSide = (kNodes - 3) * kFiner + 1;
    static constexpr double kHalf = 1.02;
    static constexpr double kFarthest = 1.15;  // rays mean nothing farther out

    // Node 1 stands at -kHalf, node kNodes - 2 at kHalf.
    static double place(int i) { return kHalf * (2.0 * (i - 1) / (kNodes - 3) - 1); }

    static double integral(Point u, const std::function<Point(Point)>& landing, double coc_radius_px,
                           double pixel_aspect) {
        // Nodes and weights of Gauss and Legendre on 0…1, five points: exact for rays of ninth order.
        constexpr double kNode[] = {0.04691007703066802, 0.23076534494715845, 0.5, 0.7692346550528415,
                                    0.953089922969332};
        constexpr double kWeight[] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                      0.23931433524968324, 0.11846344252809454};
        const double out = std::hypot(u.x, u.y);
        if (out > kFarthest) u = (kFarthest / out) * u;
        double sum = 0;
        for (int k = 0; k < 5; ++k) {
            const Point at = kNode[k] * u, d = landing(at);
            const Point aberration = Point{d.x, d.y / pixel_aspect} - coc_radius_px * at;
            sum += kWeight[k] * (aberration.x * u.x + aberration.y * u.y);
        }
        return sum;
    }

    static void refine(const double* from, std::ptrdiff_t from_step, double* to, std::ptrdiff_t to_step) {
        for (std::ptrdiff_t i = 0; i < kSide; ++i) {
            const std::ptrdiff_t node =
                std::min<std::ptrdiff_t>(i / kFiner, kNodes - 4);  // between node + 1 and node + 2
            const double t = double(i - node * kFiner) / kFiner;
            const double* p = from + node * from_step;
            const double a = p[0], b = p[from_step], c = p[2 * from_step], d = p[3 * from_step];
            to[i * to_step] =
                b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
        }
    }

    std::vector<double> values_;
};

// The unit vectors of many angles, in turns; the compiler makes several at once. Off by 2e-7 at most:
// Taylor's series within an eighth of a turn.
void unit_vectors(const double* turns, std::size_t count, float* cosines, float* sines) {
    for (std::size_t i = 0; i < count; ++i) {
        const double quarters = std::nearbyint(4 * turns[i]);
        const float x = float(kTurn / 4 * (4 * turns[i] - quarters)), z = x * x;
        const float s = x * (1 + z * (-1.0f / 6 + z * (1.0f / 120 - z * (1.0f / 5040))));
        const float c = 1 + z * (-0.5f + z * (1.0f / 24 + z * (-1.0f / 720 + z * (1.0f / 40320))));
        const int quadrant = int(quarters - 4 * std::floor(0.25 * quarters));
        const bool odd = (quadrant & 1) != 0;
        cosines[i] = (odd ? s : c) * (quadrant == 1 || quadrant == 2 ? -1.0f : 1.0f);
        sines[i] = (odd ? c : s) * (quadrant >= 2 ? -1.0f : 1.0f);
    }
}

int power_of_two_at_least(double n) {
    int side = 64;
    while (side < n) side *= 2;
    return side;
}

// The integral from 0 to t of a cubic line (Catmull and Rom) through samples that are 1 at 0 and else 0.
double integral_of_sample(double t) {
    const double a = std::min(2.0, std::abs(t)), b = a * a;
    return std::copysign(
        a < 1 ? a - b * (a * (2.5 / 3) - b * 0.375) : 2 * a - b * (2 - a * (2.5 / 3) + b * 0.125) - 1.0 / 6,
        t);
}

// Weights of samples in the integral over a pixel: samples are 1 apart, pixels `width` wide, both centred on
// 0. Between samples, intensity follows a cubic line.
struct Share {
    int sample = 0;
    float part = 1;
};
std::vector<Share> samples_in(int pixel, double width) {
    const double low = (pixel - 0.5) * width, high = (pixel + 0.5) * width;
    std::vector<Share> shares;
    for (int k = int(std::ceil(low)) - 2; k < high + 2; ++k)
        shares.push_back({k, float(integral_of_sample(high - k) - integral_of_sample(low - k))});
    return shares;
}

// Intensity summed over the squares of pixels.
PointSpread summed_over_pixels(const Wave& image, int side, double wide, double tall, const Rect& extent) {
    PointSpread spread{extent, Image<Rgba>(extent.width(), extent.height()), false};
    std::vector<std::vector<Share>> columns;
    for (int x = extent.x0; x < extent.x1; ++x) columns.push_back(samples_in(x, wide));
    for (int y = extent.y0; y < extent.y1; ++y) {
        check_cancelled();
        for (const Share& down : samples_in(y, tall)) {
            // The transform repeats: negative places are at its end.
            const std::complex<float>* row =
                &image[std::size_t(down.sample & (side - 1)) * std::size_t(side)];
            for (std::size_t i = 0; i < columns.size(); ++i) {
                float sum = 0;
                for (const Share& across : columns[i])
                    sum += across.part * std::norm(row[across.sample & (side - 1)]);
                Rgba& w = spread.weights(int(i), y - extent.y0);
                w = w + Rgba{1, 1, 1, 0} * (down.part * sum);
            }
        }
        // A cubic line beside a bright sample may pass below 0.
        for (int x = 0; x < extent.width(); ++x)
            if (Rgba& w = spread.weights(x, y - extent.y0); w.r < 0) w = {};
    }
    normalise(spread);
    return spread;
}

// Turns the wave over the pupil into that over the image, as far as pixels of `wide` samples are asked for.
void transform(Wave& wave, int side, double wide, const Rect& extent) {
    const int farthest = std::max({-extent.x0, extent.x1 - 1, 0});
    fft_square(wave, Fft(side), false, one_thread(), int(std::ceil((farthest + 0.5) * wide)) + 2);
}

PointSpread convolved(const PointSpread& a, const PointSpread& b) {
    const Rect e{a.extent.x0 + b.extent.x0, a.extent.y0 + b.extent.y0, a.extent.x1 + b.extent.x1 - 1,
                 a.extent.y1 + b.extent.y1 - 1};
    PointSpread sum{e, Image<Rgba>(e.width(), e.height()), false};
    for (int y = 0; y < a.weights.height(); ++y) {
        check_cancelled();
        for (int x = 0; x < a.weights.width(); ++x) {
            const Rgba w = a.weights(x, y);
            if (w == Rgba{}) continue;
            for (int v = 0; v < b.weights.height(); ++v) {
                Rgba* row = sum.weights.row(y + v) + x;
                for (int u = 0; u < b.weights.width(); ++u) row[u] += w * b.weights(u, v);
            }
        }
    }
    return sum;
}

}  // namespace

WaveLens::WaveLens(std::unique_ptr<const GeometricLens> lens, const Mount& mount, int wavelengths,
                   LightSpectrum light)
    : lens_(std::move(lens)),
      f_number_(mount.camera.f_number),
      pixel_mm_(mount.camera.sensor_width_mm / mount.display_width_px),
      pixel_aspect_(mount.pixel_aspect),
      wavelengths_(wavelengths > 0 ? wavelengths : 21),
      light_(light) {}

// Two per wavelength x N, which holds all detail of an intensity.
int WaveLens::samples_per_pixel() const {
    return std::max(2, int(std::ceil(2 * pixel_mm_ / (f_number_ * kShortest_nm * 1e-6))));
}

double WaveLens::pixel_waves(double wavelength_nm) const {
    return pixel_mm_ / (2 * f_number_ * wavelength_nm * 1e-6);
}

double WaveLens::tail_px() const {
    return std::min(kLongestTailPx, kTail * f_number_ * kLongest_nm * 1e-6 / pixel_mm_) + 1;
}

double WaveLens::reach_px(double coc_radius_px) const {
    return lens_->reach_px(coc_radius_px) + tail_px() * std::max(1.0, pixel_aspect_);
}

Rect WaveLens::extent_at(double coc_radius_px) const {
    const int wide =
        int(std::ceil(lens_->reach_px(coc_radius_px) / std::max(1.0, pixel_aspect_) + tail_px()));
    const int tall = int(std::ceil(wide * pixel_aspect_));
    return {-wide, -tall, wide + 1, tall + 1};
}

bool WaveLens::is_wave_at(double coc_radius_px) const {
    return samples_per_pixel() <= kMostInPixel &&
           samples_per_pixel() * extent_at(coc_radius_px).width() <= kLargestGrid;
}

// The pupil on a square grid.
struct WaveLens::PupilGrid {
    int side = 0;                  // of the transform
    int half = 0;                  // samples from the middle of the pupil to the borders of `amplitude`
    double step = 0;               // between samples, in pupil radii
    std::vector<float> amplitude;  // square root of the light that passes; coverage smooths the rim

    std::size_t columns() const { return std::size_t(2 * half + 1); }
    const float* row(int j) const { return &amplitude[std::size_t(j + half) * columns()]; }
    // Samples of the image in a pixel, whose width is this many wavelengths x 2 N.
    double samples_in(double pixel_waves) const { return step * side * pixel_waves; }
    // A row of the square that is transformed.
    std::complex<float>* row_of(Wave& wave, int j) const {
        return &wave[std::size_t(j & (side - 1)) * std::size_t(side)];
    }
};

WaveLens::PupilGrid WaveLens::pupil_grid(double wavelength_nm, FieldPosition field,
                                         const Rect& extent) const {
    const int per_pixel = samples_per_pixel();
    PupilGrid grid;
    grid.side = std::min(kLargestGrid, power_of_two_at_least(double(per_pixel) * extent.width()));
    // x u/(2 N wavelength) must be m i/side, for x = m pixel/per_pixel and u = i step.
    grid.step = per_pixel / (grid.side * pixel_waves(wavelength_nm));
    const int half = std::min(grid.side / 2 - 2, int(std::ceil(1.02 / grid.step)) + 1);
    grid.half = half;
    CoverageBuffer<double> coverage({-half, -half, half + 1, half + 1});
    std::vector<Point> outline = lens_->pupil_outline(field, 0.02 * grid.step);
    for (Point& p : outline) p = (1 / grid.step) * p;
    coverage.add_polygon(outline, 1);
    grid.amplitude.reserve(grid.columns() * grid.columns());
    for (int j = -half; j <= half; ++j) {
        check_cancelled();
        const double* covered = coverage.resolve_row(j + half);
        for (int i = -half; i <= half; ++i) {
            const double open = covered[i + half];
            const Point u{i * grid.step, j * grid.step};
            grid.amplitude.push_back(
                open < 1e-9 ? 0 : float(open * std::sqrt(lens_->pupil_transmission(u, 0.5 * grid.step))));
        }
    }
    return grid;
}

PointSpread WaveLens::monochromatic(double wavelength_nm, double coc_radius_px, FieldPosition field,
                                    const Rect& extent) const {
    return band(pupil_grid(wavelength_nm, field, extent), wavelength_nm, coc_radius_px, field, extent);
}

PointSpread WaveLens::band(const PupilGrid& grid, double wavelength_nm, double coc_radius_px,
                           FieldPosition field, const Rect& extent) const {
    std::optional<Wavefront> aberration;
    if (!lens_->is_perfect())
        aberration.emplace(lens_->landing(wavelength_nm, coc_radius_px, field), coc_radius_px, pixel_aspect_);
    const double px_to_waves = pixel_waves(wavelength_nm);
    const std::size_t columns = grid.columns();
    std::vector<double> turns(columns);
    std::vector<float> cosines(columns), sines(columns);
    Wave wave(std::size_t(grid.side) * std::size_t(grid.side));
    for (int j = -grid.half; j <= grid.half; ++j) {
        check_cancelled();
        const float* amplitude = grid.row(j);
        for (std::size_t i = 0; i < columns; ++i) {
            const Point u{(int(i) - grid.half) * grid.step, j * grid.step};
            const double defocus = 0.5 * coc_radius_px * (u.x * u.x + u.y * u.y);
            const double bent = aberration && amplitude[i] > 0 ? aberration->at(u) : 0;
            turns[i] = px_to_waves * (defocus + bent);
        }
        unit_vectors(turns.data(), columns, cosines.data(), sines.data());
        std::complex<float>* row = grid.row_of(wave, j);
        for (std::size_t i = 0; i < columns; ++i)
            row[(int(i) - grid.half) & (grid.side - 1)] =
                amplitude[i] * std::complex<float>{cosines[i], sines[i]};
    }
    const double wide = grid.samples_in(px_to_waves);
    transform(wave, grid.side, wide, extent);
    return summed_over_pixels(wave, grid.side, wide, wide / pixel_aspect_, extent);
}

PointSpread WaveLens::sum_of_bands(const Rect& extent,
                                   const std::function<PointSpread(double)>& one_band) const {
    PointSpread sum{extent, Image<Rgba>(extent.width(), extent.height()), false};
    for (const colour::SpectralBand& band : colour::spectral_bands(wavelengths_, light_)) {
        const PointSpread one = one_band(band.wavelength_nm);
        const Rgba weight{float(band.r), float(band.g), float(band.b), 0};
        for (std::size_t i = 0; i < sum.weights.size(); ++i)
            sum.weights.pixels()[i] += one.weights.pixels()[i] * weight;
    }
    normalise(sum);
    return sum;
}

PointSpread WaveLens::raw_point_spread(double coc_radius_px, FieldPosition field) const {
    const Rect extent = extent_at(coc_radius_px);
    if (is_wave_at(coc_radius_px)) {
        const PupilGrid grid = pupil_grid(kShortest_nm, field, extent);
        return sum_of_bands(extent, [&](double nm) { return band(grid, nm, coc_radius_px, field, extent); });
    }
    PointSpread spread = convolved(lens_->raw_point_spread(coc_radius_px, field), *focus_figure(field));
    normalise(spread);
    return spread;
}

// A figure is small against a pixel, so one serves a sixteenth of the half diagonal, and all are kept.
std::shared_ptr<const PointSpread> WaveLens::focus_figure(FieldPosition field) const {
    constexpr double kSteps = 16;
    std::pair<int, int> place{0, 0};
    if (lens_->varies_over_field())
        place = {int(std::lround(kSteps * field.x)), int(std::lround(kSteps * field.y))};
    std::unique_lock lock(figures_mutex_);
    std::shared_ptr<FocusFigure>& kept = figures_[place];
    if (!kept) kept = std::make_shared<FocusFigure>();
    const std::shared_ptr<FocusFigure> figure = kept;
    lock.unlock();
    const std::lock_guard making(figure->mutex);  // another thread would make the same
    if (!figure->spread)
        figure->spread =
            std::make_shared<const PointSpread>(made_figure({place.first / kSteps, place.second / kSteps}));
    return figure->spread;
}

// The figure of a perfect focus through the pupil, as far as the grid holds it. Its wave has no phase, so the
// figure only grows with the wavelength, and one transform serves them all.
PointSpread WaveLens::made_figure(FieldPosition field) const {
    const int half = std::min(int(std::ceil(tail_px())), (kLargestGrid / samples_per_pixel() - 1) / 2);
    const Rect near{-half, -half, half + 1, half + 1};
    const PupilGrid grid = pupil_grid(kShortest_nm, field, near);
    Wave wave(std::size_t(grid.side) * std::size_t(grid.side));
    for (int j = -grid.half; j <= grid.half; ++j)
        for (int i = -grid.half; i <= grid.half; ++i)
            grid.row_of(wave, j)[i & (grid.side - 1)] = grid.row(j)[i + grid.half];
    transform(wave, grid.side, samples_per_pixel(), near);
    return sum_of_bands(near, [&](double nm) {
        const double wide = grid.samples_in(pixel_waves(nm));
        return summed_over_pixels(wave, grid.side, wide, wide / pixel_aspect_, near);
    });
}

PointSpread WaveLens::point_spread(double coc_radius_px, FieldPosition field) const {
    PointSpread spread = raw_point_spread(coc_radius_px, field);
    map_into_gamut(spread);
    trim(spread);
    return spread;
}

}  // namespace petzval::kernel
