// Completes a deep picture with emptiness, and with estimated surfaces behind its opaque samples.
#pragma once

#include "engine/samples/dim.h"
#include "engine/waist/engine.h"

namespace petzval::engine {

// The stated samples, with emptiness behind transparent pixels and behind pixels so near to one that a lens
// looks past their edges: emptiness continues behind an occluder as surfaces do. It takes the rest of a
// pixel's lens and is no wider than the pixel. (Coverages of an opaque pixel's samples need not sum to 1:
// surfaces that meet in it share it.)
// Renderers end a pixel's samples at the first opaque one. What lies behind it is estimated as in a flat
// picture, by the picture's front view, unless the pixel states it.
CocSamples deep_completed(const EngineView& input, View<const unsigned char> connected, const Dim& dim);

}  // namespace petzval::engine
