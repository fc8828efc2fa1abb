// Completes a deep picture, which states all its surfaces: only emptiness is added.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// The stated samples, with emptiness behind transparent pixels and behind pixels so near to one that a lens
// looks past their edges: emptiness continues behind an occluder as surfaces do. It takes the rest of a
// pixel's lens and is no wider than the pixel. (Coverages of an opaque pixel's samples need not sum to 1:
// surfaces that meet in it share it.)
CocSamples deep_completed(const EngineView& input);

}  // namespace petzval::engine
