// Highlights spread with their complete kernels at full resolution, with the shadows of nearer things inside
// them.
#pragma once

#include "engine/engine.h"
#include "engine/highlights.h"

#include <vector>

namespace petzval::engine {

// Adds to `out`, which is `rows` of the input, what every highlight sends there; `white` as in
// HighlightSplit. A tap is dimmed by the share of its rays that nearer samples stop: the pixel q of a sample
// at radius c_q lies on the ray from the highlight (s, c) through pupil point u = (q - s)/(c - c_q), so every
// nearer sample darkens a square of that side around u in the pupil.
void spread_highlights(const Input& input, const CocSamples& samples,
                       const std::vector<Highlight>& highlights, float white, const Rect& rows,
                       View<Rgba> out);

}  // namespace petzval::engine
