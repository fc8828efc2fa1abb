#include "engine/scatter/layer_highlights.h"

#include <cmath>
#include <cstddef>

namespace petzval::engine {

std::vector<Highlight> lit_by(const std::vector<Highlight>& highlights, const CocSamples& base,
                              const std::vector<Rgba>& shares, const SampleLayer& layer) {
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
