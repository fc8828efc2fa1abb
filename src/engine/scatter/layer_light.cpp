#include "engine/scatter/layer_light.h"

#include "base/parallel.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::engine {
namespace {

// Alpha takes no part.
Rgba ratio(Rgba of, Rgba to) {
    const auto divide = [](float a, float b) { return b != 0 ? a / b : 0.0f; };
    return {divide(of.r, to.r), divide(of.g, to.g), divide(of.b, to.b), 0};
}

// What the layer is a share of.
Rgba guide(Rgba colour, bool is_light) {
    return is_light ? colour : Rgba{colour.a, colour.a, colour.a, colour.a};
}

class Shares {
public:
    Shares(const Input& input, const CocSamples& complete, const Input::Layer& layer)
        : input_(input), complete_(complete), layer_(layer) {}

    // Of the samples of pixel (x, y), into `out`.
    void of_pixel(int x, int y, Rgba* out) const {
        const std::span<const CocSample> samples = CocSamplesView(complete_).at(x, y);
        const Rgba own = ratio(layer_.colour(x, y), guide_at(x, y));
        if (input_.deep_dims_itself) return std::fill_n(out, samples.size(), own), void();
        const bool alone = !samples.empty() && cover(samples[0]) > laws::kOpaqueAlone;
        Rgba shown, of_layer;  // the light of what the pixel shows, and the layer's by the shares so far
        float open = 1;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            const CocSample& s = samples[i];
            const bool is_own = alone && i == 0;
            out[i] = is_own ? own : of_surface(x, y, s.coc_px, own);
            const Rgba light = seen(s, open) * guide(s.colour, layer_.is_light);
            shown += light, of_layer += light * out[i];
        }
        // What is seen of the pixel is the layer's own.
        const Rgba off = own - ratio(of_layer, shown);
        open = 1;
        for (std::size_t i = 0; i < samples.size(); ++i)
            if (seen(samples[i], open) > 0) out[i] += off;
    }

private:
    static float cover(const CocSample& s) { return s.colour.a + s.empty; }
    // The share of a sample that shows; `open` is what those in front leave of the pixel.
    static float seen(const CocSample& s, float& open) {
        const float covers = cover(s);
        if (covers <= 0) return open;
        const float share = std::min(1.0f, open / covers);
        open = std::max(0.0f, open - share * covers);
        return share;
    }
    Rgba guide_at(int x, int y) const { return guide(input_.colour(x, y), layer_.is_light); }

    // The share in the pixels around that show a surface at that radius, along sixteen directions.
    Rgba of_surface(int x, int y, float coc_px, Rgba otherwise) const {
        constexpr int kDirections = 16, kFarthest = 64, kPixels = 3;
        static const std::array<std::array<float, 2>, kDirections> directions = [] {
            std::array<std::array<float, 2>, kDirections> d{};
            for (int i = 0; i < kDirections; ++i)
                d[std::size_t(i)] = {std::cos(float(2 * M_PI) * float(i) / kDirections),
                                     std::sin(float(2 * M_PI) * float(i) / kDirections)};
            return d;
        }();
        const float same = std::max(0.25f, 0.03f * std::abs(coc_px));
        Rgba layer, all;
        for (const auto& [dx, dy] : directions)
            for (int t = 1, found = 0; t <= kFarthest && found < kPixels; ++t) {
                const int u = x + int(std::lround(dx * float(t))), v = y + int(std::lround(dy * float(t)));
                if (!input_.colour.rect().contains(u, v)) break;
                if (std::abs(input_.coc_px(u, v) - coc_px) > same) continue;
                const float weight = 1 / float(t * t);
                layer += weight * layer_.colour(u, v), all += weight * guide_at(u, v), ++found;
            }
        const Rgba share = ratio(layer, all);
        return {all.r != 0 ? share.r : otherwise.r, all.g != 0 ? share.g : otherwise.g,
                all.b != 0 ? share.b : otherwise.b, 0};
    }

    const Input& input_;
    const CocSamples& complete_;
    const Input::Layer& layer_;
};

}  // namespace

std::vector<Rgba> shares_of(const Input& input, const CocSamples& complete, const Input::Layer& layer) {
    std::vector<Rgba> shares(complete.samples.size());
    const Shares made(input, complete, layer);
    parallel_for(input.height(), *input.workers, [&](int y) {
        for (int x = 0; x < input.width(); ++x)
            made.of_pixel(
                x, y,
                shares.data() + complete.first[std::size_t(y) * std::size_t(input.width()) + std::size_t(x)]);
    });
    return shares;
}

CocSamples lit_by(const CocSamples& base, const std::vector<Rgba>& shares, const Input::Layer& layer) {
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

std::vector<Highlight> lit_by(const std::vector<Highlight>& highlights, const CocSamples& base,
                              const std::vector<Rgba>& shares, const Input::Layer& layer) {
    std::vector<Highlight> lit;
    if (!layer.is_light) return lit;
    lit.reserve(highlights.size());
    // The sample of a pixel that a highlight was taken of.
    const auto share_at = [&](int x, int y, float coc_px) {
        const std::size_t pixel = std::size_t(y) * std::size_t(base.width) + std::size_t(x);
        std::size_t nearest = base.first[pixel];
        const auto off = [&](std::size_t i) { return std::abs(base.samples[i].coc_px - coc_px); };
        for (std::size_t i = nearest; i < base.first[pixel + 1]; ++i)
            if (off(i) < off(nearest)) nearest = i;
        return shares[nearest];
    };
    for (Highlight h : highlights) {
        Rgba share;
        for (int y = h.y; y < h.y + h.size; ++y)
            for (int x = h.x; x < h.x + h.size; ++x) share += share_at(x, y, h.coc_px);
        h.colour = h.colour * (share * (1 / float(h.size * h.size)));
        lit.push_back(h);
    }
    return lit;
}

}  // namespace petzval::engine
