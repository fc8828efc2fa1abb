// The highlights of a layer of the picture.
#pragma once

#include "engine/lights/highlights.h"
#include "engine/waist/engine.h"

#include <vector>

namespace petzval::engine {

// The layer's light in the place of the beauty's, whose highlights were removed from `base`; shares: of each
// sample (engine/samples/layer_shares.h). Empty for mattes.
std::vector<Highlight> lit_by(const std::vector<Highlight>& highlights, const CocSamples& base,
                              const std::vector<Rgba>& shares, const SampleLayer& layer);

}  // namespace petzval::engine
