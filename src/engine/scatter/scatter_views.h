// What the scatter engine takes a scene for, and what it takes for highlights, in place of its result.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// A row of panels for the nearest sample of every pixel, the next one behind it and so on: left its light,
// premultiplied by the share of the pixel that it takes up, right the number of the depth layer in which it
// is composited: 0 about focus, negative in front. Samples that hold no light are left out. At most four
// rows; a warning says if there is more. Errors: OutOfMemory.
Result<Output> run_scatter_layers(const Input& input);

// Left the highlights as they are drawn, each with its whole kernel: the result less these is what the levels
// drew. Right the same light where it was taken out of the sharp picture; its alpha is 1 where some was.
// Errors: Cancelled, OutOfMemory.
Result<Output> run_scatter_highlights(const Input& input);

}  // namespace petzval::engine
