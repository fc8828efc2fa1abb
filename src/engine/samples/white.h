// Level above which light counts as bright in a frame.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval::engine {

// Four times the mean luminance of the covered picture, to the nearest power of two, so that a frame that
// shows a little more or less of the same scene has the same lights.
float white_of(View<const Rgba> picture, Workers& workers);

}  // namespace petzval::engine
