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

// Samples of a pixel, on average: as many as a deep picture states, or about as many as the silhouettes of a
// flat one give.
double samples_per_pixel(const EngineView& input);

// The memory that layers of a picture take beside it and their own pictures, bytes per pixel: a copy of its
// samples with their sources, and the layers' shares of each sample. Fitted to 6 scenes of 2 sizes with 1 to
// 3 layers.
double layer_bytes_per_pixel(std::size_t layers, double samples);

// The peak of the whole process in bytes for a flat picture, fitted to 10 scenes of 3 sizes
// (docs/results/memory.md). has_spare: the result takes the place of the colour. Pictures with deep samples,
// plates or holdouts have no estimate: the largest number.
std::size_t bytes_at_once(const EngineView& input, const LevelRule& rule, const HighlightSplit& split,
                          bool has_spare);

}  // namespace petzval::engine
