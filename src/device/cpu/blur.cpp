#include "device/cpu/blur.h"

#include "base/parallel.h"
#include "device/cpu/gather_taps.h"

#include <algorithm>
#include <cmath>

namespace petzval::device {

using namespace engine;

namespace {

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

// Blurs `channels` interleaved floats per cell, band by band of rows.
void blur_cells(float* cells, int width, int height, int channels, const BlurAxis& x, const BlurAxis& y,
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

void blur_layer(BlurLayer& layer, const Blur& blur, Workers& workers) {
    const int w = blur.cells_across(), h = blur.cells_down();
    blur_cells(&layer.light.pixels()->r, w, h, 4, blur.x, blur.y, workers);
    blur_cells(layer.covered.pixels(), w, h, 1, blur.x, blur.y, workers);
}

BlurReader::BlurReader(const BlurLayer& layer, int level, int width)
    : layer_(&layer), level_(level), light_(std::size_t(layer.light.width())), covered_(light_.size()) {
    const float per_cell = 1 / float(1 << level);
    const int last = layer.light.width() - 1;
    for (int x = 0; x < width; ++x) {
        const float at = std::clamp((float(x) + 0.5f) * per_cell - 0.5f, 0.0f, float(last));
        const int left = int(at);
        places_.push_back({std::size_t(left), std::size_t(std::min(left + 1, last)), at - float(left)});
    }
}

void BlurReader::go_to_row(int y) {
    const float per_cell = 1 / float(1 << level_);
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

}  // namespace petzval::device
