// Measures the difference between two pictures; petzval/compare.h and docs/reference/report.md define the
// measures.
//
// SSIM: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error
// visibility to structural similarity", IEEE Transactions on Image Processing 13(4), 2004: 11 x 11 Gaussian
// window of sigma 1.5, K1 = 0.01, K2 = 0.03, mean over the windows that lie wholly inside the picture. If the
// picture or the mask is narrower than a window, windows are cut at the border and renormalised.
#include "petzval/compare.h"

#include "base/parallel.h"
#include "image/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace petzval {
namespace {

constexpr int kWindowRadius = 5;
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;  // (K L)^2 with L = 1
constexpr int kBandRows = 32;
constexpr float kLogCeiling = 64, kLogGrey = 0.18f;

enum class Transfer { Linear, Srgb, Log };

// NaN counts as black; see difference().
float clipped(float x, float ceiling) { return x > 0 ? std::min(x, ceiling) : 0; }

float encoded(float x, Transfer transfer) {
    switch (transfer) {
        case Transfer::Linear:
            return clipped(x, 1);
        case Transfer::Srgb:
            return srgb_code(clipped(x, 1));
        case Transfer::Log:
            break;
    }
    return std::log2(1 + clipped(x, kLogCeiling) / kLogGrey) / std::log2(1 + kLogCeiling / kLogGrey);
}

// A NaN on one side alone is the greatest error there is, not a black pixel.
double difference(float reference, float test, Transfer transfer) {
    if (std::isnan(reference) != std::isnan(test)) return 1;
    return double(encoded(test, transfer)) - double(encoded(reference, transfer));
}

struct Input {
    View<const Rgba> reference, test;
    View<const float> mask;
    float exposure = 1;

    int width() const { return reference.width(); }
    int height() const { return reference.height(); }
    bool counts(int x, int y) const { return mask.empty() || mask(x, y) > 0.5f; }
};

// Sums of one band of rows; bands are added in order, so that threads do not change the result.
struct ChannelSums {
    std::array<double, 3> squares{};  // by Transfer
    double energy_reference = 0, energy_test = 0, max_error = -1;
    int max_x = 0, max_y = 0;
    std::int64_t pixels = 0;
};

void add_channel(ChannelSums& sums, float reference, float test, float exposure, int x, int y) {
    if (std::isfinite(reference)) sums.energy_reference += double(reference);
    if (std::isfinite(test)) sums.energy_test += double(test);
    for (const Transfer transfer : {Transfer::Linear, Transfer::Srgb, Transfer::Log}) {
        const double d = difference(reference * exposure, test * exposure, transfer);
        sums.squares[std::size_t(transfer)] += d * d;
        if (transfer == Transfer::Linear && std::abs(d) > sums.max_error)
            sums.max_error = std::abs(d), sums.max_x = x, sums.max_y = y;
    }
}

ChannelSums band_sums(const Input& in, int y0, int y1) {
    ChannelSums sums;
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < in.width(); ++x) {
            if (!in.counts(x, y)) continue;
            ++sums.pixels;
            const Rgba &a = in.reference(x, y), &b = in.test(x, y);
            add_channel(sums, a.r, b.r, in.exposure, x, y);
            add_channel(sums, a.g, b.g, in.exposure, x, y);
            add_channel(sums, a.b, b.b, in.exposure, x, y);
        }
    return sums;
}

int band_count(const Input& in) { return (in.height() + kBandRows - 1) / kBandRows; }

ChannelSums channel_sums(const Input& in, Workers& workers) {
    std::vector<ChannelSums> bands(std::size_t(band_count(in)));
    parallel_for(band_count(in), workers, [&](int i) {
        bands[std::size_t(i)] = band_sums(in, i * kBandRows, std::min(in.height(), (i + 1) * kBandRows));
    });
    ChannelSums total;
    for (const ChannelSums& band : bands) {
        for (std::size_t t = 0; t < total.squares.size(); ++t) total.squares[t] += band.squares[t];
        total.energy_reference += band.energy_reference;
        total.energy_test += band.energy_test;
        total.pixels += band.pixels;
        if (band.max_error > total.max_error)
            total.max_error = band.max_error, total.max_x = band.max_x, total.max_y = band.max_y;
    }
    return total;
}

// The moments of a window for SSIM: weighted means of a, b, a a, b b, a b.
using Moments = std::array<float, 5>;

std::array<float, 2 * kWindowRadius + 1> gaussian_window() {
    std::array<float, 2 * kWindowRadius + 1> weights{};
    for (int i = -kWindowRadius; i <= kWindowRadius; ++i)
        weights[std::size_t(i + kWindowRadius)] = float(std::exp(-i * i / (2 * 1.5 * 1.5)));
    return weights;
}
const std::array<float, 2 * kWindowRadius + 1> kWindow = gaussian_window();

// The weighted mean of at(i) over the part of the window around `centre` inside 0…count-1.
template <typename At>
Moments window_mean(int centre, int count, const At& at) {
    Moments sum{};
    float weight_sum = 0;
    const int first = std::max(0, centre - kWindowRadius), last = std::min(count - 1, centre + kWindowRadius);
    for (int i = first; i <= last; ++i) {
        const float weight = kWindow[std::size_t(i - centre + kWindowRadius)];
        const Moments& m = at(i);
        for (std::size_t k = 0; k < m.size(); ++k) sum[k] += weight * m[k];
        weight_sum += weight;
    }
    for (float& s : sum) s /= weight_sum;
    return sum;
}

double ssim_of(const Moments& m) {
    const double a = double(m[0]), b = double(m[1]);
    const double variance_a = double(m[2]) - a * a, variance_b = double(m[3]) - b * b;
    const double covariance = double(m[4]) - a * b;
    return (2 * a * b + kC1) * (2 * covariance + kC2) /
           ((a * a + b * b + kC1) * (variance_a + variance_b + kC2));
}

float luma(const Rgba& c, float exposure, Transfer transfer) {
    return luminance({encoded(c.r * exposure, transfer), encoded(c.g * exposure, transfer),
                      encoded(c.b * exposure, transfer), 1});
}

// Window means along one row.
void blur_row(const Input& in, Transfer transfer, int y, Moments* out) {
    std::vector<Moments> points(std::size_t(in.width()));
    for (int x = 0; x < in.width(); ++x) {
        const float a = luma(in.reference(x, y), in.exposure, transfer);
        const float b = luma(in.test(x, y), in.exposure, transfer);
        points[std::size_t(x)] = {a, b, a * a, b * b, a * b};
    }
    for (int x = 0; x < in.width(); ++x)
        out[x] = window_mean(x, in.width(), [&](int i) -> const Moments& { return points[std::size_t(i)]; });
}

struct SsimSums {
    double inside = 0, all = 0;  // windows wholly inside; every window
    std::int64_t inside_count = 0, all_count = 0;
};

SsimSums band_ssim(const Input& in, Transfer transfer, int y0, int y1) {
    const int first = std::max(0, y0 - kWindowRadius), last = std::min(in.height(), y1 + kWindowRadius);
    const std::size_t width = std::size_t(in.width());
    std::vector<Moments> rows(width * std::size_t(last - first));
    for (int y = first; y < last; ++y) blur_row(in, transfer, y, &rows[std::size_t(y - first) * width]);
    SsimSums sums;
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < in.width(); ++x) {
            if (!in.counts(x, y)) continue;
            const Moments m = window_mean(y, in.height(), [&](int i) -> const Moments& {
                return rows[std::size_t(i - first) * width + std::size_t(x)];
            });
            const double ssim = ssim_of(m);
            sums.all += ssim, ++sums.all_count;
            if (x >= kWindowRadius && x < in.width() - kWindowRadius && y >= kWindowRadius &&
                y < in.height() - kWindowRadius)
                sums.inside += ssim, ++sums.inside_count;
        }
    return sums;
}

double ssim(const Input& in, Transfer transfer, Workers& workers) {
    std::vector<SsimSums> bands(std::size_t(band_count(in)));
    parallel_for(band_count(in), workers, [&](int i) {
        bands[std::size_t(i)] =
            band_ssim(in, transfer, i * kBandRows, std::min(in.height(), (i + 1) * kBandRows));
    });
    SsimSums total;
    for (const SsimSums& band : bands) {
        total.inside += band.inside, total.inside_count += band.inside_count;
        total.all += band.all, total.all_count += band.all_count;
    }
    return total.inside_count > 0 ? total.inside / double(total.inside_count)
                                  : total.all / double(total.all_count);
}

double psnr(double sum_of_squares, std::int64_t pixels) {
    if (sum_of_squares == 0) return std::numeric_limits<double>::infinity();
    return 10 * std::log10(3 * double(pixels) / sum_of_squares);
}

std::string size_text(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

Result<Input> checked(View<const Rgba> reference, View<const Rgba> test, const CompareSettings& settings) {
    const auto invalid = [](std::string text) { return Error{ErrorCode::InvalidArgument, std::move(text)}; };
    const std::string size = size_text(reference.width(), reference.height());
    if (reference.empty() || test.empty()) return invalid("compare: a picture has no pixels");
    if (reference.width() != test.width() || reference.height() != test.height())
        return invalid("compare: the reference is " + size + ", the test is " +
                       size_text(test.width(), test.height()) + "; they must be the same size");
    const View<const float>& mask = settings.mask;
    if (!mask.empty() && (mask.width() != reference.width() || mask.height() != reference.height()))
        return invalid("compare: the mask is " + size_text(mask.width(), mask.height()) +
                       ", the pictures are " + size + "; they must be the same size");
    if (!(settings.exposure > 0) || !std::isfinite(settings.exposure))
        return invalid("compare: compare.exposure is " + std::to_string(settings.exposure) +
                       "; it must be positive");
    return Input{reference, test, mask, float(settings.exposure)};
}

// Sums of squares over each square of the grid, and the error of each pixel.
struct Squares {
    int side = 0, across = 0, down = 0;
    std::vector<double> sums;
};

Squares squares_of(const Input& in, Plane& error) {
    Squares squares;
    squares.side = std::max(8, std::max(in.width(), in.height()) / 24);
    squares.across = (in.width() + squares.side - 1) / squares.side;
    squares.down = (in.height() + squares.side - 1) / squares.side;
    squares.sums.assign(std::size_t(squares.across) * std::size_t(squares.down), 0);
    for (int y = 0; y < in.height(); ++y)
        for (int x = 0; x < in.width(); ++x) {
            if (!in.counts(x, y)) continue;
            const Rgba &a = in.reference(x, y), &b = in.test(x, y);
            double& sum =
                squares.sums[std::size_t(y / squares.side * squares.across) + std::size_t(x / squares.side)];
            for (const auto& [from, to] : {std::pair(a.r, b.r), {a.g, b.g}, {a.b, b.b}}) {
                const double d = difference(from * in.exposure, to * in.exposure, Transfer::Srgb);
                sum += d * d;
                error(x, y) = std::max(error(x, y), float(std::abs(d)));
            }
        }
    return squares;
}

// The worst squares; a neighbour of a chosen one is left out.
std::vector<WorstPlace> worst_of(const Squares& squares, const Rect& frame, int most) {
    std::vector<WorstPlace> worst;
    std::vector<int> order;
    for (int i = 0; i < int(squares.sums.size()); ++i)
        if (squares.sums[std::size_t(i)] > 0) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return squares.sums[std::size_t(a)] > squares.sums[std::size_t(b)];
    });
    for (const int i : order) {
        if (int(worst.size()) >= most) break;
        const int x = i % squares.across * squares.side, y = i / squares.across * squares.side;
        const Rect area = Rect{x, y, x + squares.side, y + squares.side}.intersected(frame);
        const bool touches = std::any_of(worst.begin(), worst.end(), [&](const WorstPlace& other) {
            return !area.grown(1).intersected(other.area).empty();
        });
        if (touches) continue;
        const double values = 3.0 * area.width() * area.height();
        worst.push_back({area, std::sqrt(squares.sums[std::size_t(i)] / values)});
    }
    return worst;
}

}  // namespace

Result<Difference> difference(View<const Rgba> reference, View<const Rgba> test,
                              const CompareSettings& settings, int most_places) {
    const auto in = checked(reference, test, settings);
    if (!in) return in.error();
    Difference result;
    result.error = Plane(in->width(), in->height());
    const Squares squares = squares_of(*in, result.error);
    result.worst = worst_of(squares, result.error.rect(), most_places);
    return result;
}

Result<Comparison> compare(View<const Rgba> reference, View<const Rgba> test,
                           const CompareSettings& settings) {
    const auto input = checked(reference, test, settings);
    if (!input) return input.error();
    const Input& in = *input;
    const std::shared_ptr<Workers> workers = workers_of(settings.threads, settings.workers);
    const ChannelSums sums = channel_sums(in, *workers);
    if (sums.pixels == 0)
        return Error{ErrorCode::InvalidArgument, "compare: no pixel of the mask is above 0.5"};
    Comparison result;
    result.psnr_lin = psnr(sums.squares[std::size_t(Transfer::Linear)], sums.pixels);
    result.psnr_srgb = psnr(sums.squares[std::size_t(Transfer::Srgb)], sums.pixels);
    result.psnr_log = psnr(sums.squares[std::size_t(Transfer::Log)], sums.pixels);
    result.ssim_lin = ssim(in, Transfer::Linear, *workers);
    result.ssim_srgb = ssim(in, Transfer::Srgb, *workers);
    result.max_error = sums.max_error;
    result.max_error_x = sums.max_x;
    result.max_error_y = sums.max_y;
    result.energy_ratio =
        sums.energy_reference == sums.energy_test ? 1 : sums.energy_test / sums.energy_reference;
    return result;
}

}  // namespace petzval
