// The memory that a frame takes in one strip, known from its radii and lights before any sample is made.
#pragma once

#include "engine/lights/highlights.h"
#include "engine/scatter/plan.h"
#include "engine/waist/engine.h"

#include <cstddef>

namespace petzval::engine {

// Cells of the levels on which the picture's own pixels are spread, per pixel: about the number of its
// sources. Wide discs are spread on cells of many pixels.
double cells_per_pixel(View<const float> coc_px, const LevelRule& rule, Workers& workers);

// The memory of the lights that are drawn together, bytes: it grows with their number and radius.
std::size_t lights_bytes(const EngineView& input, const HighlightSplit& split);

// The peak of the whole process in bytes for a flat picture, fitted to 10 scenes of 3 sizes
// (docs/results/memory.md). has_spare: the result takes the place of the colour. Pictures with deep samples,
// plates, layers or holdouts have no estimate: the largest number.
std::size_t bytes_at_once(const EngineView& input, const LevelRule& rule, const HighlightSplit& split,
                          bool has_spare);

}  // namespace petzval::engine
