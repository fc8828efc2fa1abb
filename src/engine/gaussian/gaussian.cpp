// The draft engine: the sharp picture mixed with a smaller and a larger Gaussian blur
// (docs/published.md). Always round, whatever the lens: it has the disc's second moment, not its
// shape.
#include "engine/gaussian/gaussian.h"

#include "base/parallel.h"
#include "engine/gaussian/gaussian_blur.h"
#include "engine/gaussian/gaussian_mix.h"
#include "engine/waist/memory.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace petzval::engine {
namespace {

// A disc of radius r has the variance r^2/4 per axis, and a pixel 1/12.
Sigma sigma_of(double radius_px, double pixel_aspect) {
    const auto sigma = [](double r) { return std::sqrt(r * r / 4 + 1.0 / 12); };
    return {sigma(radius_px), sigma(radius_px * pixel_aspect)};
}

struct Radii {
    float nearest_px = 0, farthest_px = 0;
    float largest_px() const { return std::max(-nearest_px, farthest_px); }
};

Picture sharp_copy(const Input& input) {
    Picture picture = Picture::uninitialised(input.width(), input.height());
    for (int y = 0; y < input.height(); ++y) std::copy_n(input.colour.row(y), input.width(), picture.row(y));
    return picture;
}

// The layers of blurred light, nearest first; the sharp one lies between the second and the third. What
// lies behind near things is shown by the backdrop.
enum LayerName { kNearLarge, kNearSmall, kFarSmall, kFarLarge, kBackdrop, kLayers };

class LayeredMix {
public:
    LayeredMix(const Input& input, const Radii& radii, float band_px)
        : in_(input), near_(-radii.nearest_px, band_px), far_(radii.farthest_px, band_px) {
        const std::array<float, kLayers> radius_px{near_.large_px(), near_.small_px(), far_.small_px(),
                                                   far_.large_px(), std::max(near_.small_px(), 1.0f)};
        for (int k = 0; k < kLayers; ++k) {
            used_[std::size_t(k)] = k < kFarSmall || k == kBackdrop ? near_.blurs() : far_.blurs();
            sigma_[std::size_t(k)] = sigma_of(double(radius_px[std::size_t(k)]), input.pixel_aspect);
        }
    }

    void run(View<Rgba> out) {
        make_layers();
        constexpr int kBand = 16;
        parallel_for((in_.height() + kBand - 1) / kBand, *in_.workers, [&](int band) {
            std::array<BlurReader, kLayers> readers;
            for (std::size_t k = 0; k < kLayers; ++k)
                if (used_[k]) readers[k] = BlurReader(layers_[k], in_.width());
            for (int y = band * kBand; y < std::min(in_.height(), (band + 1) * kBand); ++y) {
                for (std::size_t k = 0; k < kLayers; ++k)
                    if (used_[k]) readers[k].go_to_row(y);
                for (int x = 0; x < in_.width(); ++x) out(x, y) = composite(readers, x, y);
            }
        });
    }

private:
    MixWeights weights(float coc_px) const { return coc_px < 0 ? near_(-coc_px) : far_(coc_px); }

    // Every layer on the grid that its own blur needs. Rows are shared out by cells of the coarsest.
    void make_layers() {
        int coarsest = 0;
        for (std::size_t k = 0; k < kLayers; ++k) {
            if (!used_[k]) continue;
            layers_[k] = BlurLayer::on_grid(blur_level(sigma_[k]), in_.width(), in_.height());
            per_cell_[k] = std::ldexp(1.0f, -2 * layers_[k].level);
            coarsest = std::max(coarsest, layers_[k].level);
        }
        const int size = 1 << coarsest;
        parallel_for((in_.height() + size - 1) / size, *in_.workers, [&](int row) {
            for (int y = row * size; y < std::min(in_.height(), (row + 1) * size); ++y)
                for (int x = 0; x < in_.width(); ++x) deposit(x, y);
        });
        for (std::size_t k = 0; k < kLayers; ++k)
            if (used_[k]) blur(layers_[k], sigma_[k], in_.width(), in_.height(), *in_.workers);
    }

    void deposit(int x, int y) {
        const float coc = in_.coc_px(x, y);
        const Rgba colour = in_.colour(x, y);
        const MixWeights w = weights(coc);
        const auto add = [&](LayerName name, float share) {
            if (share <= 0 || !used_[name]) return;
            BlurLayer& layer = layers_[name];
            const float part = share * per_cell_[name];
            layer.light(x >> layer.level, y >> layer.level) += part * colour;
            layer.covered(x >> layer.level, y >> layer.level) += part;
        };
        add(coc < 0 ? kNearSmall : kFarSmall, w.small);
        add(coc < 0 ? kNearLarge : kFarLarge, w.large);
        add(kBackdrop, coc < 0 ? w.sharp : 1);
    }

    // Each layer takes of the pixel's lens what it arrives with, or what is left.
    Rgba composite(const std::array<BlurReader, kLayers>& readers, int x, int y) const {
        Rgba sum;
        float free = 1;
        const auto take = [&](Rgba light, float covered) {
            if (covered <= kLeastArea) return;
            const float taken = std::min(covered, free);
            sum += (taken / covered) * light;
            free -= taken;
        };
        const auto take_layer = [&](LayerName layer) {
            if (used_[layer]) take(readers[layer].light(x), readers[layer].covered(x));
        };
        take_layer(kNearLarge);
        take_layer(kNearSmall);
        const float coc = in_.coc_px(x, y), sharp = weights(coc).sharp;
        take(sharp * in_.colour(x, y), sharp);
        take_layer(kFarSmall);
        take_layer(kFarLarge);
        // Under the soft edge of something near: what lies around it. Else: more of what was seen.
        if (free > kLeastArea && coc < 0 && used_[kBackdrop] && readers[kBackdrop].covered(x) > kLeastArea) {
            sum += (free / readers[kBackdrop].covered(x)) * readers[kBackdrop].light(x);
            free = 0;
        }
        return free < 1 - kLeastArea ? sum * (1 / (1 - free)) : in_.colour(x, y);
    }

    static constexpr float kLeastArea = 1e-5f;
    const Input& in_;
    RadiusMix near_, far_;
    std::array<BlurLayer, kLayers> layers_;
    std::array<bool, kLayers> used_{};
    std::array<Sigma, kLayers> sigma_{};
    std::array<float, kLayers> per_cell_{};  // of a pixel
};

// The whole picture, blurred as a disc of that radius would.
BlurLayer blurred_picture(const Input& input, float radius_px) {
    const Sigma sigma = sigma_of(double(radius_px), input.pixel_aspect);
    BlurLayer layer = BlurLayer::on_grid(blur_level(sigma), input.width(), input.height());
    const int size = 1 << layer.level;
    const float per_pixel = 1 / float(size * size);
    parallel_for(layer.light.height(), *input.workers, [&](int row) {
        for (int y = row * size; y < std::min(input.height(), (row + 1) * size); ++y)
            for (int x = 0; x < input.width(); ++x)
                layer.light(x / size, row) += per_pixel * input.colour(x, y);
    });
    blur(layer, sigma, input.width(), input.height(), *input.workers);
    return layer;
}

// Every pixel mixes the three pictures by weights(x, y); or shows one of them.
template <typename Weights>
void mix_by_pixel(const Input& input, float largest_px, const Weights& weights, View<Rgba> out) {
    const GaussianView view = input.gaussian.view;
    const BlurLayer small = blurred_picture(input, largest_px / 2),
                    large = blurred_picture(input, largest_px);
    constexpr int kBand = 16;
    parallel_for((input.height() + kBand - 1) / kBand, *input.workers, [&](int band) {
        BlurReader smaller(small, input.width()), larger(large, input.width());
        for (int y = band * kBand; y < std::min(input.height(), (band + 1) * kBand); ++y) {
            smaller.go_to_row(y), larger.go_to_row(y);
            for (int x = 0; x < input.width(); ++x) {
                const MixWeights w = weights(x, y);
                out(x, y) = view == GaussianView::BlurSmall    ? smaller.light(x)
                            : view == GaussianView::BlurLarge  ? larger.light(x)
                            : view == GaussianView::FocusIndex ? Rgba{w.sharp, w.sharp, w.sharp, 1}
                            : w.sharp == 1                     ? input.colour(x, y)
                                           : w.sharp * input.colour(x, y) + w.small * smaller.light(x) +
                                                 w.large * larger.light(x);
            }
        }
    });
}

// The result, and the layers with the copies that blurring makes of one, on the finest grid that any needs.
std::size_t bytes_per_pixel(const Input& input, const Radii& radii) {
    float smallest_px = radii.largest_px();
    for (const float side : {-radii.nearest_px, radii.farthest_px})
        if (side > kWithinPixelPx) smallest_px = std::min(smallest_px, side);
    const double small_px = double(std::max(smallest_px / 2, kWithinPixelPx));
    const int level = blur_level(sigma_of(small_px, input.pixel_aspect));
    return sizeof(Rgba) + ((8 * (sizeof(Rgba) + sizeof(float))) >> (2 * level));
}

}  // namespace

Result<Output> run_gaussian(const Input& input) {
    const auto start = std::chrono::steady_clock::now();
    const GaussianOptions& options = input.gaussian;
    const Radii radii{input.nearest_coc_px, input.farthest_coc_px};
    const bool by_depth = options.style == GaussianStyle::Wgld;
    if (const Status fits = fits_memory(input, bytes_per_pixel(input, radii), "gaussian"); !fits)
        return fits.error();
    Output output;
    output.image = sharp_copy(input);
    const bool is_sharp = radii.largest_px() <= kWithinPixelPx && options.view == GaussianView::Result;
    if (options.view == GaussianView::Sharp || is_sharp) return output;

    const float band_px = float(options.focus_band.value_or(0));
    if (by_depth) {
        const DepthMix mix(input, radii.largest_px());
        mix_by_pixel(input, radii.largest_px(), mix, output.image);
    } else if (options.style == GaussianStyle::Plain || options.view != GaussianView::Result) {
        const RadiusMix mix(radii.largest_px(), band_px);
        mix_by_pixel(
            input, radii.largest_px(), [&](int x, int y) { return mix(std::abs(input.coc_px(x, y))); },
            output.image);
    } else {
        LayeredMix(input, radii, band_px).run(output.image);
    }
    if (!input.progress->advance(1)) return Error{ErrorCode::Cancelled, "cancelled"};
    output.stages = {
        {"gaussian", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()}};
    return output;
}

}  // namespace petzval::engine
