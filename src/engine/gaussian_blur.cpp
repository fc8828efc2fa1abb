#include "engine/gaussian_blur.h"

#include "base/parallel.h"
#include "engine/gather_taps.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr double kLeastSigmaCells = 0.8;

// Weights at -radius…radius that sum to 1 and whose variance is that asked for: a cut Gaussian is narrower
// than a whole one, so it starts from a wider.
std::vector<float> gaussian_weights(double sigma) {
    const int radius = std::max(1, int(std::ceil(3 * sigma)));
    std::vector<double> weights(std::size_t(2 * radius + 1));
    double wider = std::max(sigma, 0.05);
    for (int pass = 0; pass < 4; ++pass) {
        double sum = 0, moment = 0;
        for (int k = -radius; k <= radius; ++k) {
            const double w = std::exp(-0.5 * k * k / (wider * wider));
            weights[std::size_t(k + radius)] = w;
            sum += w, moment += w * k * k;
        }
        for (double& w : weights) w /= sum;
        if (moment > 0) wider *= std::clamp(sigma / std::sqrt(moment / sum), 0.5, 2.0);
    }
    return {weights.begin(), weights.end()};
}

double sigma_in_cells(double sigma_px, int level) {
    const double s = std::ldexp(1.0, level);
    return std::sqrt(std::max(0.0, sigma_px * sigma_px - (level > 0 ? s * s / 4 : 0))) / s;
}

// How much of a kernel at each of n cells lies inside; the last cell may lie inside in part.
std::vector<float> share_inside(const std::vector<float>& weights, int cells, int level, int pixels) {
    const int radius = int(weights.size() / 2), size = 1 << level;
    std::vector<float> shares(std::size_t(cells), 0.0f);
    for (int i = 0; i < cells; ++i)
        for (int k = std::max(0, i - radius); k <= std::min(cells - 1, i + radius); ++k)
            shares[std::size_t(i)] +=
                weights[std::size_t(k - i + radius)] * float(std::min(size, pixels - k * size)) / float(size);
    return shares;
}

// Rows of floats with room around them, blurred along one axis.
class Rows {
public:
    Rows(int width, int height, int margin_x, int margin_y)
        : margin_x_(margin_x),
          margin_y_(margin_y),
          stride_((width + 2 * margin_x + 2 * kGatherGroup - 1) / kGatherGroup * kGatherGroup),
          floats_(std::size_t(stride_) * std::size_t(height + 2 * margin_y) + kGatherGroup, 0.0f) {}
    float* row(int y) { return floats_.data() + std::ptrdiff_t(y + margin_y_) * stride_ + margin_x_; }
    int stride() const { return stride_; }

private:
    int margin_x_, margin_y_, stride_;
    std::vector<float> floats_;
};

// One pass over rows of `width` floats: taps `step` floats apart.
void pass(Rows& from, Rows& to, int width, int height, std::ptrdiff_t step, const std::vector<float>& weights,
          int threads) {
    const int radius = int(weights.size() / 2);
    std::vector<std::ptrdiff_t> offsets;
    for (int k = -radius; k <= radius; ++k) offsets.push_back(k * step);
    constexpr int kBand = 16;
    parallel_for((height + kBand - 1) / kBand, threads, [&](int band) {
        const int y0 = band * kBand, rows = std::min(kBand, height - y0);
        const TapJob job{offsets.data(),
                         weights.data(),
                         int(weights.size()),
                         1,
                         (width + kGatherGroup - 1) / kGatherGroup * kGatherGroup,
                         rows,
                         from.stride(),
                         to.stride()};
        gather_one(job, {from.row(y0), to.row(y0)});
    });
}

// Blurs `channels` interleaved floats per cell.
void blur_cells(float* cells, int width, int height, int channels, const std::vector<float>& along_x,
                const std::vector<float>& along_y, int threads) {
    const int margin_x = int(along_x.size() / 2) * channels, margin_y = int(along_y.size() / 2);
    const int row = width * channels;
    Rows in(row, height, margin_x, 0), between(row, height, 0, margin_y), out(row, height, 0, 0);
    for (int y = 0; y < height; ++y) std::copy_n(cells + std::ptrdiff_t(y) * row, row, in.row(y));
    pass(in, between, row, height, channels, along_x, threads);
    pass(between, out, row, height, between.stride(), along_y, threads);
    for (int y = 0; y < height; ++y) std::copy_n(out.row(y), row, cells + std::ptrdiff_t(y) * row);
}

}  // namespace

int blur_level(Sigma sigma) {
    const double least = std::min(sigma.x_px, sigma.y_px);
    int level = 0;
    while (level < 14 && sigma_in_cells(least, level + 1) >= kLeastSigmaCells) ++level;
    return level;
}

BlurLayer BlurLayer::on_grid(int level, int width, int height) {
    const int size = 1 << level;
    const int w = (width + size - 1) / size, h = (height + size - 1) / size;
    return {level, Picture(w, h), Plane(w, h)};
}

BlurLayer BlurLayer::halved(int width, int height) const {
    BlurLayer half = on_grid(level + 1, width, height);
    for (int y = 0; y < light.height(); ++y)
        for (int x = 0; x < light.width(); ++x) {
            half.light(x / 2, y / 2) += 0.25f * light(x, y);
            half.covered(x / 2, y / 2) += 0.25f * covered(x, y);
        }
    return half;
}

void blur(BlurLayer& layer, Sigma sigma, int width, int height, int threads) {
    const std::vector<float> along_x = gaussian_weights(sigma_in_cells(sigma.x_px, layer.level));
    const std::vector<float> along_y = gaussian_weights(sigma_in_cells(sigma.y_px, layer.level));
    const int w = layer.light.width(), h = layer.light.height();
    blur_cells(&layer.light.pixels()->r, w, h, 4, along_x, along_y, threads);
    blur_cells(layer.covered.pixels(), w, h, 1, along_x, along_y, threads);
    const std::vector<float> inside_x = share_inside(along_x, w, layer.level, width);
    const std::vector<float> inside_y = share_inside(along_y, h, layer.level, height);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const float scale = 1 / (inside_x[std::size_t(x)] * inside_y[std::size_t(y)]);
            layer.light(x, y) *= scale;
            layer.covered(x, y) *= scale;
        }
}

BlurReader::BlurReader(const BlurLayer& layer, int width)
    : layer_(&layer), light_(std::size_t(layer.light.width())), covered_(light_.size()) {
    const float per_cell = 1 / float(1 << layer.level);
    const int last = layer.light.width() - 1;
    for (int x = 0; x < width; ++x) {
        const float at = std::clamp((float(x) + 0.5f) * per_cell - 0.5f, 0.0f, float(last));
        const int left = int(at);
        places_.push_back({std::size_t(left), std::size_t(std::min(left + 1, last)), at - float(left)});
    }
}

void BlurReader::go_to_row(int y) {
    const float per_cell = 1 / float(1 << layer_->level);
    const int last = layer_->light.height() - 1;
    const float at = std::clamp((float(y) + 0.5f) * per_cell - 0.5f, 0.0f, float(last));
    const int top = int(at), bottom = std::min(top + 1, last);
    const float share = at - float(top);
    for (int x = 0; x < layer_->light.width(); ++x) {
        const std::size_t i = std::size_t(x);
        const Rgba a = layer_->light(x, top), b = layer_->light(x, bottom);
        light_[i] = a + share * (b - a);
        const float c = layer_->covered(x, top), d = layer_->covered(x, bottom);
        covered_[i] = c + share * (d - c);
    }
}

}  // namespace petzval::engine
