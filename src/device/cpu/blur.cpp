#include "device/cpu/blur.h"

#include "base/parallel.h"
#include "device/cpu/gather_taps.h"
#include "engine/waist/cells.h"

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

// Taps `step` floats apart, on `rows` rows of floats from begin to end.
void pass(Rows& from, int from_y, Rows& to, int to_y, int begin, int end, int rows, std::ptrdiff_t step,
          const std::vector<float>& weights) {
    const int radius = int(weights.size() / 2);
    std::vector<std::ptrdiff_t> offsets;
    for (int k = -radius; k <= radius; ++k) offsets.push_back(k * step);
    const TapJob job{offsets.data(),
                     weights.data(),
                     int(weights.size()),
                     1,
                     (end - begin + kGatherGroup - 1) / kGatherGroup * kGatherGroup,
                     rows,
                     from.stride(),
                     to.stride()};
    gather_one(job, {from.row(from_y) + begin, to.row(to_y) + begin});
}

constexpr int kBand = 16;  // rows of cells that are blurred together

// Blurs `channels` interleaved floats per cell, band by band of rows; lit: of each band, when it is blurred.
void blur_cells(float* cells, int width, int height, int channels, const BlurAxis& x, const BlurAxis& y,
                const std::vector<LitCells>& lit, Workers& workers) {
    const int row = width * channels, bands = int(lit.size());
    Rows between(row, height, 0, y.radius());
    const auto each_band = [&](const auto& work) {
        parallel_for(bands, workers, [&](int band) {
            const LitCells part = lit[std::size_t(band)];
            if (!part.empty())
                work(band * kBand, std::min(kBand, height - band * kBand), part.begin * channels,
                     part.end * channels);
        });
    };
    each_band([&](int first, int rows, int begin, int end) {
        Rows in(row, kBand, x.radius() * channels, 0);
        for (int k = 0; k < rows; ++k) std::copy_n(cells + std::ptrdiff_t(first + k) * row, row, in.row(k));
        pass(in, 0, between, first, begin, end, rows, channels, x.weights);
    });
    each_band([&](int first, int rows, int begin, int end) {
        Rows out(row, kBand, 0, 0);
        pass(between, first, out, 0, begin, end, rows, between.stride(), y.weights);
        for (int k = 0; k < rows; ++k) {
            const float* from = out.row(k);
            float* to = cells + std::ptrdiff_t(first + k) * row;
            for (int i = begin / channels; i < end / channels; ++i) {
                const float scale = 1 / (x.inside[std::size_t(i)] * y.inside[std::size_t(first + k)]);
                for (int c = 0; c < channels; ++c) to[i * channels + c] = scale * from[i * channels + c];
            }
        }
    });
}

}  // namespace

std::vector<CellPlace> places_in_cells(const Blur& blur, int width) {
    const CellAxis axis(blur.level, blur.cells_across());
    std::vector<CellPlace> places;
    for (int x = 0; x < width; ++x) {
        const float at = axis.place(x);
        const int left = int(at);
        places.push_back(
            {std::size_t(left), std::size_t(std::min(left + 1, axis.cells() - 1)), at - float(left)});
    }
    return places;
}

void RowOfLight::add_to(Rgba* light, float* covered, LitCells& lit, float share) const {
    for (int i = lit_.begin; i < lit_.end; ++i) {
        light[i] += share * light_[std::size_t(i)];
        covered[i] += share * covered_[std::size_t(i)];
    }
    lit.add(lit_);
}

void RowOfLight::clear() {
    std::fill(light_.begin() + lit_.begin, light_.begin() + lit_.end, Rgba{});
    std::fill(covered_.begin() + lit_.begin, covered_.begin() + lit_.end, 0.0f);
    lit_ = {};
}

void blur_layer(BlurLayer& layer, const Blur& blur, Workers& workers) {
    const int w = blur.cells_across(), h = blur.cells_down();
    std::vector<LitCells> reached(layer.lit.size()), bands(std::size_t((h + kBand - 1) / kBand));
    for (int y = 0; y < h; ++y)
        if (const LitCells own = layer.lit[std::size_t(y)]; !own.empty())
            for (int v = std::max(0, y - blur.y.radius()); v <= std::min(h - 1, y + blur.y.radius()); ++v)
                reached[std::size_t(v)].add(
                    {std::max(0, own.begin - blur.x.radius()), std::min(w, own.end + blur.x.radius())});
    for (int y = 0; y < h; ++y) bands[std::size_t(y / kBand)].add(reached[std::size_t(y)]);
    blur_cells(&layer.light.pixels()->r, w, h, 4, blur.x, blur.y, bands, workers);
    blur_cells(layer.covered.pixels(), w, h, 1, blur.x, blur.y, bands, workers);
    layer.lit = std::move(reached);
}

bool BlurReader::go_to_row(int y) {
    const int cells = layer_->light.width(), last = layer_->light.height() - 1;
    const float at = CellAxis(level_, last + 1).place(y);
    const int top = int(at), bottom = std::min(top + 1, last);
    const float share = at - float(top);
    LitCells lit = layer_->lit[std::size_t(top)];
    lit.add(layer_->lit[std::size_t(bottom)]);
    lit_begin_ = lit_end_ = 0;
    if (lit.empty()) return false;
    // Pixels between a cell that is lit and one that is not are lit.
    const int size = 1 << level_;
    lit_begin_ = lit.begin == 0 ? 0 : (lit.begin - 1) * size + size / 2;
    lit_end_ = lit.end == cells ? int(places_->size()) : lit.end * size + size / 2;
    for (int x = std::max(0, lit.begin - 1); x < std::min(cells, lit.end + 1); ++x) {
        const std::size_t i = std::size_t(x);
        const Rgba a = layer_->light(x, top), b = layer_->light(x, bottom);
        light_[i] = a + share * (b - a);
        const float c = layer_->covered(x, top), d = layer_->covered(x, bottom);
        covered_[i] = c + share * (d - c);
    }
    return true;
}

}  // namespace petzval::device
