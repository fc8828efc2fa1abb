// Ways to defocus that others published, each written from its description alone: what our engines are
// measured against. All take the picture and its signed radii and nothing else, as the engines do.
#pragma once

#include "petzval/image.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <thread>
#include <vector>

namespace petzval::baselines {

struct Input {
    View<const Rgba> colour;   // scene-linear, premultiplied
    View<const float> coc_px;  // signed radius, + behind focus
    int threads = 1;
};

// Every pixel gathers from those whose disc may reach it; each file says more.
Picture gather(const Input& input);
Picture weighted_scatter(const Input& input);
Picture layered_fft(const Input& input);
Picture rectangle_spreading(const Input& input);

// body(i) for each i in 0…count-1 on so many threads.
inline void in_parallel(int count, int threads, const std::function<void(int)>& body) {
    std::atomic<int> next = 0;
    std::vector<std::thread> all;
    for (int t = 0; t < std::max(1, threads); ++t)
        all.emplace_back([&] {
            for (int i = next++; i < count; i = next++) body(i);
        });
    for (std::thread& t : all) t.join();
}

// The layer of a radius among `layers` of equal width between the smallest and the largest, 0 the nearest.
class LayerRule {
public:
    LayerRule(View<const float> coc_px, int layers) : layers_(layers) {
        low_ = high_ = coc_px(0, 0);
        for (int y = 0; y < coc_px.height(); ++y)
            for (int x = 0; x < coc_px.width(); ++x) {
                low_ = std::min(low_, coc_px(x, y));
                high_ = std::max(high_, coc_px(x, y));
            }
    }
    int layer_of(float coc_px) const {
        const float place = high_ > low_ ? (coc_px - low_) / (high_ - low_) : 0;
        return std::clamp(int(place * float(layers_)), 0, layers_ - 1);
    }
    float middle_px(int layer) const {
        return low_ + (high_ - low_) * (float(layer) + 0.5f) / float(layers_);
    }

private:
    int layers_;
    float low_, high_;
};

// `below` seen past `above`, both premultiplied.
inline Rgba over(Rgba above, Rgba below) { return above + (1 - std::min(above.a, 1.0f)) * below; }

// The picture in so many layers, each blurred(input, rule, layer), one over the other.
template <typename Blurred>
Picture layer_by_layer(const Input& input, int count, const Blurred& blurred) {
    const LayerRule rule(input.coc_px, count);
    std::vector<Picture> layers(static_cast<std::size_t>(count));
    in_parallel(count, input.threads, [&](int i) { layers[std::size_t(i)] = blurred(input, rule, i); });
    Picture out(input.colour.width(), input.colour.height());
    for (std::size_t i = 0; i < out.size(); ++i) {
        Rgba below{};
        for (std::size_t layer = layers.size(); layer-- > 0;) below = over(layers[layer].pixels()[i], below);
        out.pixels()[i] = below.a > 1e-6f ? below * (1 / below.a) : below;
    }
    return out;
}

}  // namespace petzval::baselines
