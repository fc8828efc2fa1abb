// Samples of a deep pixel as shares of the lens.
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"

namespace petzval::engine {

// Converts samples that dim each other (Samples::deep_dims_itself) to shares of the lens. A ray straight
// through the pixel meets the same light as before. Translucent samples are dimmed by the translucent ones in
// front of them. An opaque sample takes the rest of the lens anyway, and rays that pass its occluders see all
// of it. Only translucent samples that are composited in the same layer (engine/scatter/sources.h) dim an
// opaque one, and the opaque one hides the rest of that layer. Call this function after highlights were taken
// out, because highlights find their occluders themselves.
void share_lens_area(CocSamples& samples, Workers& workers);

}  // namespace petzval::engine
