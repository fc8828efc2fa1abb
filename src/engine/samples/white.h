// Level above which light counts as bright in a frame.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include <algorithm>

namespace petzval::engine {

// Four times the mean luminance of the covered picture, to the nearest power of two, so that a frame that
// shows a little more or less of the same scene has the same lights.
float white_of(View<const Rgba> picture, Workers& workers);

// Luminance that counts as black in a frame with this white (0: unknown); keeps reciprocals finite.
constexpr float black_of(float white) { return white > 0 ? std::max(1e-20f, 1e-3f * white) : 1e-3f; }

}  // namespace petzval::engine
