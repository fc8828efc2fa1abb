// More colour layers of one picture, blurred by the beauty's own plan: what of each sample's light is a
// layer's.
//
// Everything that decides (which surface, how much of it, what hides behind it, which light is a highlight)
// was decided of the beauty. A layer has a share of each sample's light, by channel. Shares of light are
// linear in the layer, so that layers which sum to the beauty still sum to it when all are blurred. Shares of
// coverage (mattes) stay within the range of the layer, and those of a matte and its complement sum to 1.
#pragma once

#include "engine/waist/engine.h"

#include <span>
#include <vector>

namespace petzval::engine {

// Fraction of every sample that belongs to each layer: 1 if the layer is all of the light (of the coverage
// for a matte). `complete` are the samples of input.samples.colour before highlights were removed. A sample
// that fills its pixel has the pixel's fraction; a hidden sample has the fraction of the surrounding pixels
// that show the same surface; the fractions of several visible samples average to the pixel's.
class LayerShares {
public:
    // Number of layers that are done at once; each costs memory.
    static constexpr std::size_t kAtOnce = 4;
    LayerShares(const EngineView& input, const CocSamples& complete, std::span<const SampleLayer> layers);
    // The shares of one layer, for every sample.
    std::vector<Rgba> of(std::size_t layer) const;

private:
    std::size_t layers_;
    std::vector<Rgba> all_;  // for each sample the shares of all layers
};

// The layer's light in the place of the beauty's; coverage stays.
CocSamples lit_by(const CocSamples& base, const std::vector<Rgba>& shares, const SampleLayer& layer);

}  // namespace petzval::engine
