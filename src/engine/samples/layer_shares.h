// Further colour layers of a picture, blurred by the plan of its beauty: the fraction of each sample's light
// that belongs to a layer.
//
// The beauty alone determines surfaces, coverage, hidden background and highlights. A layer has a fraction of
// each sample's light, per channel. These fractions are linear in the layer, so layers that sum to the beauty
// still sum to it after the blur. Fractions of coverage (mattes) stay within the range of the layer, and
// those of a matte and its complement sum to 1.
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
    // Number of layers that are processed at once; each needs memory.
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
