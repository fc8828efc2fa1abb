#include "engine/samples/layer_shares.h"

#include "base/parallel.h"
#include "engine/samples/seen_share.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace petzval::engine {
namespace {

// Ratio of two colours, channel by channel; alpha is ignored.
Rgba ratio(Rgba of, Rgba to) {
    const auto divide = [](float a, float b) { return b != 0 ? a / b : 0.0f; };
    return {divide(of.r, to.r), divide(of.g, to.g), divide(of.b, to.b), 0};
}

// The quantity that the layer is a fraction of: the light, or the coverage.
Rgba guide(Rgba colour, bool is_light) {
    return is_light ? colour : Rgba{colour.a, colour.a, colour.a, colour.a};
}

// The pixels that a search visits in each direction, nearest first.
constexpr int kDirections = 16, kFarthest = 64;
using Steps = std::array<std::array<std::array<int, 2>, kFarthest>, kDirections>;

const Steps& steps() {
    static const Steps all = [] {
        Steps s{};
        for (std::size_t i = 0; i < kDirections; ++i)
            for (std::size_t t = 0; t < kFarthest; ++t) {
                const float angle = float(2 * M_PI) * float(i) / kDirections, far = float(t + 1);
                s[i][t] = {int(std::lround(std::cos(angle) * far)), int(std::lround(std::sin(angle) * far))};
            }
        return s;
    }();
    return all;
}

// The shares of a surface at some radius: each layer's light over the guide's, in the pixels around that show
// it.
struct OfSurface {
    float coc_px = 0;
    std::vector<Rgba> layer, guide;  // sums of light
    Rgba share(std::size_t i, Rgba otherwise) const {
        const Rgba found = ratio(layer[i], guide[i]), &all = guide[i];
        return {all.r != 0 ? found.r : otherwise.r, all.g != 0 ? found.g : otherwise.g,
                all.b != 0 ? found.b : otherwise.b, 0};
    }
};

// Finds the shares of rows of pixels, all layers at once. Pixels of a square share what was found for one of
// them: of 2 x 2, or of more where the surface is blurred wider.
class Shares {
public:
    static constexpr int kRows = 8;  // rows that are done together: the side of the largest square
    Shares(const EngineView& input, const CocSamples& complete, std::span<const SampleLayer> layers)
        : input_(input), complete_(complete), all_layers_(layers), layers_(layers.size()) {
        for (std::size_t side = 2, i = 0; i < kSizes; side *= 2, ++i)
            found_[i].resize((std::size_t(input.width()) + side - 1) / side);
    }

    // Rows y0…y0 + kRows - 1; `out` as LayerShares has it.
    void of_rows(int y0, Rgba* out) {
        for (int y = y0; y < std::min(y0 + kRows, input_.height()); ++y) {
            for (std::size_t i = 0; i < kSizes; ++i)
                if (y % (2 << i) == 0)
                    for (auto& square : found_[i]) square.clear();
            for (int x = 0; x < input_.width(); ++x)
                of_pixel(
                    x, y,
                    out + layers_ *
                              complete_.first[std::size_t(y) * std::size_t(input_.width()) + std::size_t(x)]);
        }
    }

private:
    static constexpr std::size_t kSizes = 3;

    void of_pixel(int x, int y, Rgba* out) {
        const std::span<const CocSample> samples = CocSamplesView(complete_).at(x, y);
        const bool alone = !samples.empty() && cover(samples[0]) > laws::kOpaqueAlone;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const OfSurface* const surface = input_.samples.deep_dims_itself || (alone && k == 0)
                                                 ? nullptr
                                                 : &of_surface(x, y, samples[k].coc_px);
            for (std::size_t i = 0; i < layers_; ++i) {
                const Rgba own = own_share(x, y, i);
                out[k * layers_ + i] = surface ? surface->share(i, own) : own;
            }
        }
        if (!input_.samples.deep_dims_itself)
            for (std::size_t i = 0; i < layers_; ++i) meet(samples, own_share(x, y, i), i, out);
    }
    Rgba own_share(int x, int y, std::size_t i) const {
        const SampleLayer& layer = all_layers_[i];
        return ratio(layer.colour(x, y), guide(input_.samples.colour(x, y), layer.is_light));
    }

    // Scales the fractions so that their mean over the visible samples is the layer's own.
    void meet(std::span<const CocSample> samples, Rgba own, std::size_t i, Rgba* shares) const {
        const bool is_light = all_layers_[i].is_light;
        // Light of the visible samples, and the layer's part of it by the present shares.
        Rgba shown, of_layer;
        float open = 1;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const Rgba light = seen(samples[k], open) * guide(samples[k].colour, is_light);
            shown += light, of_layer += light * shares[k * layers_ + i];
        }
        const Rgba is = ratio(of_layer, shown);
        open = 1;
        for (std::size_t k = 0; k < samples.size(); ++k) {
            Rgba& share = shares[k * layers_ + i];
            if (seen(samples[k], open) <= 0) continue;
            if (is_light)
                share += own - is;
            else
                share = {towards(share.r, is.r, own.r), towards(share.g, is.g, own.g),
                         towards(share.b, is.b, own.b), 0};
        }
    }
    // Moves one of several values with mean `is` so that their mean becomes `own`; each stays within 0…1.
    static float towards(float value, float is, float own) {
        if (own == is) return value;
        const float end = own > is ? std::max(1.0f, own) : std::min(0.0f, own);
        return value + (own - is) / (end - is) * (end - value);
    }

    // The shares of a surface with that radius, from the surrounding pixels that show it.
    const OfSurface& of_surface(int x, int y, float coc_px) {
        const float same = std::max(0.25f, 0.03f * std::abs(coc_px));
        auto& square = square_at(x, std::abs(coc_px));
        for (const OfSurface& known : square)
            if (std::abs(known.coc_px - coc_px) <= 0.25f * same) return known;
        OfSurface& found = square.emplace_back();
        found.coc_px = coc_px, found.layer.resize(layers_), found.guide.resize(layers_);
        constexpr int kPixels = 3;
        for (const auto& direction : steps())
            for (int t = 0, pixels = 0; t < kFarthest && pixels < kPixels; ++t) {
                const int u = x + direction[std::size_t(t)][0], v = y + direction[std::size_t(t)][1];
                if (!input_.samples.coc_px.rect().contains(u, v)) break;
                if (std::abs(input_.samples.coc_px(u, v) - coc_px) > same) continue;
                add(u, v, 1 / float((t + 1) * (t + 1)), found), ++pixels;
            }
        return found;
    }
    void add(int x, int y, float weight, OfSurface& to) const {
        for (std::size_t i = 0; i < layers_; ++i) {
            const SampleLayer& layer = all_layers_[i];
            to.layer[i] += weight * layer.colour(x, y);
            to.guide[i] += weight * guide(input_.samples.colour(x, y), layer.is_light);
        }
    }
    // Squares grow with the blur, as where hidden parts are filled in (samples/hidden.h).
    std::vector<OfSurface>& square_at(int x, float blur_px) {
        const std::size_t i = blur_px < 12 ? 0 : blur_px < 36 ? 1 : 2;
        return found_[i][std::size_t(x) / (std::size_t(2) << i)];
    }

    const EngineView& input_;
    const CocSamples& complete_;
    std::span<const SampleLayer> all_layers_;
    std::size_t layers_;  // number of layers
    // Per size and square, for the rows under way.
    std::array<std::vector<std::vector<OfSurface>>, kSizes> found_;
};

}  // namespace

LayerShares::LayerShares(const EngineView& input, const CocSamples& complete,
                         std::span<const SampleLayer> layers)
    : layers_(layers.size()), all_(layers_ * complete.samples.size()) {
    const int bands = (input.height() + Shares::kRows - 1) / Shares::kRows;
    parallel_for(bands, *input.services.workers, [&](int band) {
        Shares(input, complete, layers).of_rows(band * Shares::kRows, all_.data());
    });
}

std::vector<Rgba> LayerShares::of(std::size_t layer) const {
    std::vector<Rgba> shares(layers_ > 0 ? all_.size() / layers_ : 0);
    for (std::size_t k = 0; k < shares.size(); ++k) shares[k] = all_[k * layers_ + layer];
    return shares;
}

CocSamples lit_by(const CocSamples& base, const std::vector<Rgba>& shares, const SampleLayer& layer) {
    CocSamples lit;
    lit.width = base.width, lit.first = base.first, lit.samples = base.samples;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        Rgba& colour = lit.samples[i].colour;
        const float a = colour.a;
        colour = guide(colour, layer.is_light) * shares[i];
        colour.a = a;
    }
    return lit;
}

}  // namespace petzval::engine
