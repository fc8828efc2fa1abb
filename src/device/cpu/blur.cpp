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

// Blurs `channels` interleaved floats per cell, band by band of rows. lit: the columns of each band that are
// lit once it is blurred.
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

LitCells RowOfLight::cells() const {
    return {across_->cell(pixels_.begin, 0), across_->cell(pixels_.end - 1, 2) + 1};
}

void RowOfLight::fold_ends() {
    const std::size_t last = light_.size() - 2;
    light_[1] += light_[0], covered_[1] += covered_[0];
    light_[last] += light_[last + 1], covered_[last] += covered_[last + 1];
    light_[0] = light_[last + 1] = {}, covered_[0] = covered_[last + 1] = 0;
}

void RowOfLight::add_to(Rgba* light, float* covered, LitCells& lit, float share) const {
    const LitCells own = cells();
    for (int i = own.begin; i < own.end; ++i) {
        light[i] += share * light_[std::size_t(i) + 1];
        covered[i] += share * covered_[std::size_t(i) + 1];
    }
    lit.add(own);
}

void RowOfLight::clear() {
    const LitCells own = cells();
    std::fill(light_.begin() + own.begin + 1, light_.begin() + own.end + 1, Rgba{});
    std::fill(covered_.begin() + own.begin + 1, covered_.begin() + own.end + 1, 0.0f);
    pixels_ = {};
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

bool BlurReader::go_to_row(int y, LitCells pixels) {
    y_ = y, lit_begin_ = lit_end_ = 0;
    if (!tile_) return go_to_cells(pixels);
    const Rect& reached = tile_->reached();
    if (y < reached.y0 || y >= reached.y1) return false;
    lit_begin_ = reached.x0, lit_end_ = reached.x1;
    return true;
}

bool BlurReader::go_to_cells(LitCells pixels) {
    const auto row_of = [&](int k) { return down_->cell(y_, k); };
    LitCells lit;
    for (int k = 0; k < 3; ++k) lit.add(layer_->lit[std::size_t(row_of(k))]);
    if (lit.empty()) return false;
    lit_begin_ = across_->begin(lit.begin), lit_end_ = across_->end(lit.end);
    const int last = across_->cells() - 1;
    const int begin = std::max({0, lit.begin - 2, across_->cell(pixels.begin, 0)}),
              end = std::min({last + 1, lit.end + 2, across_->cell(pixels.end - 1, 2) + 1});
    const std::array<float, 3> shares = down_->shares(y_);
    const auto cells = [&](const auto& plane, auto& to) {
        const auto a = plane.row(row_of(0)), b = plane.row(row_of(1)), c = plane.row(row_of(2));
        for (int x = begin; x < end; ++x)
            to[std::size_t(x) + 1] =
                down_->level() == 0 ? b[x] : shares[0] * a[x] + shares[1] * b[x] + shares[2] * c[x];
        to.front() = to[1], to.back() = to[std::size_t(last) + 1];
    };
    cells(layer_->light, light_), cells(layer_->covered, covered_);
    return begin < end;
}

}  // namespace petzval::device
