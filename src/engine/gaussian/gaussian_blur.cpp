#include "engine/gaussian/gaussian_blur.h"

#include "base/parallel.h"
#include "device/cpu/gather_taps.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// Taps `step` floats apart, on `rows` rows of `width` floats.
void pass(Rows& from, int from_y, Rows& to, int to_y, int width, int rows, std::ptrdiff_t step,
          const std::vector<float>& weights) {
    const int radius = int(weights.size() / 2);
    std::vector<std::ptrdiff_t> offsets;
    for (int k = -radius; k <= radius; ++k) offsets.push_back(k * step);
    const TapJob job{offsets.data(),
                     weights.data(),
                     int(weights.size()),
                     1,
                     (width + kGatherGroup - 1) / kGatherGroup * kGatherGroup,
                     rows,
                     from.stride(),
                     to.stride()};
    gather_one(job, {from.row(from_y), to.row(to_y)});
}

// A kernel along one axis, and how much of it lies inside the picture at each cell.
struct Axis {
    std::vector<float> weights, inside;
    int radius() const { return int(weights.size() / 2); }
};

// Blurs `channels` interleaved floats per cell, band by band of rows.
void blur_cells(float* cells, int width, int height, int channels, const Axis& x, const Axis& y,
                Workers& workers) {
    constexpr int kBand = 16;
    const int row = width * channels, bands = (height + kBand - 1) / kBand;
    Rows between(row, height, 0, y.radius());
    parallel_for(bands, workers, [&](int band) {
        const int first = band * kBand, rows = std::min(kBand, height - first);
        Rows in(row, kBand, x.radius() * channels, 0);
        for (int k = 0; k < rows; ++k) std::copy_n(cells + std::ptrdiff_t(first + k) * row, row, in.row(k));
        pass(in, 0, between, first, row, rows, channels, x.weights);
    });
    parallel_for(bands, workers, [&](int band) {
        const int first = band * kBand, rows = std::min(kBand, height - first);
        Rows out(row, kBand, 0, 0);
        pass(between, first, out, 0, row, rows, between.stride(), y.weights);
        for (int k = 0; k < rows; ++k) {
            const float* from = out.row(k);
            float* to = cells + std::ptrdiff_t(first + k) * row;
            for (int i = 0; i < width; ++i) {
                const float scale = 1 / (x.inside[std::size_t(i)] * y.inside[std::size_t(first + k)]);
                for (int c = 0; c < channels; ++c) to[i * channels + c] = scale * from[i * channels + c];
            }
        }
    });
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

void blur(BlurLayer& layer, Sigma sigma, int width, int height, Workers& workers) {
    const int w = layer.light.width(), h = layer.light.height();
    const auto axis = [&](double sigma_px, int cells, int pixels) {
        std::vector<float> weights = gaussian_weights(sigma_in_cells(sigma_px, layer.level));
        std::vector<float> inside = share_inside(weights, cells, layer.level, pixels);
        return Axis{std::move(weights), std::move(inside)};
    };
    const Axis x = axis(sigma.x_px, w, width), y = axis(sigma.y_px, h, height);
    blur_cells(&layer.light.pixels()->r, w, h, 4, x, y, workers);
    blur_cells(layer.covered.pixels(), w, h, 1, x, y, workers);
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
