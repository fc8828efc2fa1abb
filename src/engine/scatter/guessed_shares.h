// Marks the samples that were estimated. The marks are drawn through the beauty's plan like a layer; they
// come from the samples alone, not from the estimator.
#pragma once

#include "engine/waist/view.h"

#include <vector>

namespace petzval::engine {

// The share of every sample that the picture does not show: 1 for a surface found behind another, 0 for a
// visible one; 0 everywhere in a picture whose samples are all given or without fill, and for surfaces that a
// clean plate shows. A matte, in every channel.
std::vector<Rgba> guessed_shares(const EngineView& view, const CocSamples& complete);

}  // namespace petzval::engine
