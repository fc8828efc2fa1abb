#include "glare/bloom.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace petzval::glare {
namespace {

// Halving averages with weights 1 3 3 1, doubling interpolates with the same: each spreads light by a
// variance of 3/4 of the finer pixel squared.
constexpr double kResampleVariance = 0.75;
// Blurs narrower than this many pixels are made on the finer level, where the Gaussian is sampled well.
constexpr double kNarrowest_px = 1.5;

// Index in 0…n-1 of a mirror image that repeats the border pixel.
int mirrored(int i, int n) {
    const int period = 2 * n;
    i = ((i % period) + period) % period;
    return i < n ? i : period - 1 - i;
}

Picture halved(const Picture& fine, Workers& workers) {
    constexpr float kWeight[4] = {0.125f, 0.375f, 0.375f, 0.125f};
    Picture coarse(fine.width() / 2, fine.height() / 2);
    parallel_for(coarse.height(), workers, [&](int y) {
        const Rgba* rows[4];
        for (int k = 0; k < 4; ++k) rows[k] = fine.row(mirrored(2 * y - 1 + k, fine.height()));
        for (int x = 0; x < coarse.width(); ++x) {
            Rgba sum;
            for (int k = 0; k < 4; ++k) {
                const int column = mirrored(2 * x - 1 + k, fine.width());
                Rgba down;
                for (int j = 0; j < 4; ++j) down += kWeight[j] * rows[j][column];
                sum += kWeight[k] * down;
            }
            coarse(x, y) = sum;
        }
    });
    return coarse;
}

// fine += coarse, interpolated.
void add_doubled(Picture& fine, const Picture& coarse, Workers& workers) {
    parallel_for(fine.height(), workers, [&](int y) {
        const int j = y / 2;
        const Rgba* near_row = coarse.row(j);
        const Rgba* far_row = coarse.row(mirrored(y % 2 ? j + 1 : j - 1, coarse.height()));
        for (int x = 0; x < fine.width(); ++x) {
            const int i = x / 2, other = mirrored(x % 2 ? i + 1 : i - 1, coarse.width());
            fine(x, y) +=
                0.5625f * near_row[i] + 0.1875f * (near_row[other] + far_row[i]) + 0.0625f * far_row[other];
        }
    });
}

std::vector<float> gaussian(double sigma_px) {
    const int radius = std::max(1, int(std::ceil(4 * sigma_px)));
    std::vector<float> weights;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += std::exp(-0.5 * i * i / (sigma_px * sigma_px));
    for (int i = -radius; i <= radius; ++i)
        weights.push_back(float(std::exp(-0.5 * i * i / (sigma_px * sigma_px)) / sum));
    return weights;
}

Picture blurred(const Picture& in, double sigma_x, double sigma_y, Workers& workers) {
    Picture across(in.width(), in.height()), out(in.width(), in.height());
    const std::vector<float> wx = gaussian(sigma_x), wy = gaussian(sigma_y);
    const int rx = int(wx.size()) / 2, ry = int(wy.size()) / 2;
    parallel_for(in.height(), workers, [&](int y) {
        std::vector<Rgba> row(std::size_t(in.width() + 2 * rx));
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = in(mirrored(int(i) - rx, in.width()), y);
        for (int x = 0; x < in.width(); ++x) {
            Rgba sum;
            for (std::size_t k = 0; k < wx.size(); ++k) sum += wx[k] * row[std::size_t(x) + k];
            across(x, y) = sum;
        }
    });
    parallel_for(in.height(), workers, [&](int y) {
        for (int k = -ry; k <= ry; ++k) {
            const Rgba* row = across.row(mirrored(y + k, in.height()));
            const float weight = wy[std::size_t(k + ry)];
            for (int x = 0; x < in.width(); ++x) out(x, y) += weight * row[x];
        }
    });
    return out;
}

// A blur on level `level` of the pyramid such that all steps together have the deviation sigma_px.
double sigma_on_level(double sigma_px, int level) {
    const double pixel = std::exp2(level);
    // Steps k = 0…level-1, down and up, on pixels of 2^k: 2 * 3/4 * sum 4^k.
    const double resampling = 2 * kResampleVariance * (pixel * pixel - 1) / 3;
    return std::sqrt(std::max(sigma_px * sigma_px - resampling, 1e-4)) / pixel;
}

// The coarsest level on which the blur is still at least kNarrowest_px wide.
int level_for(double sigma_px, int coarsest) {
    int level = 0;
    while (level < coarsest && sigma_on_level(sigma_px, level + 1) >= kNarrowest_px) ++level;
    return level;
}

// Sides rounded up to a multiple of 2^levels, filled with the mirror image.
Picture padded(const Picture& light, int levels) {
    const int unit = 1 << levels;
    Picture out((light.width() + unit - 1) / unit * unit, (light.height() + unit - 1) / unit * unit);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            out(x, y) = light(mirrored(x, light.width()), mirrored(y, light.height()));
    return out;
}

}  // namespace

Picture bloom(const Picture& light, double widest_px, double pixel_aspect, Workers& workers) {
    std::vector<double> sigmas;
    for (double sigma = widest_px; sigmas.empty() || sigma >= 0.8; sigma /= 2) sigmas.push_back(sigma);
    const int coarsest = level_for(std::min(1.0, pixel_aspect) * widest_px, 30);
    std::vector<Picture> levels, layers;
    levels.push_back(padded(light, coarsest));
    for (int l = 0; l < coarsest; ++l) levels.push_back(halved(levels.back(), workers));
    for (const Picture& level : levels) layers.emplace_back(level.width(), level.height());
    const float share = 1 / float(sigmas.size());
    for (const double sigma : sigmas) {
        const int l = level_for(std::min(1.0, pixel_aspect) * sigma, coarsest);
        const Picture layer = blurred(levels[std::size_t(l)], sigma_on_level(sigma, l),
                                      sigma_on_level(sigma * pixel_aspect, l), workers);
        Picture& sum = layers[std::size_t(l)];
        for (std::size_t i = 0; i < sum.size(); ++i) sum.pixels()[i] += share * layer.pixels()[i];
    }
    for (std::size_t l = layers.size(); l-- > 1;) add_doubled(layers[l - 1], layers[l], workers);
    Picture out(light.width(), light.height());
    for (int y = 0; y < out.height(); ++y)
        std::copy_n(layers[0].row(y), std::size_t(out.width()), out.row(y));
    return out;
}

}  // namespace petzval::glare
