// From one picture with depth to all that a lens may see of the scene: silhouettes taken apart, hidden parts
// continued.
#pragma once

#include "engine/engine.h"

namespace petzval::engine {

// Every sample of every pixel, nearest first. A deep input says it all itself; of a flat one, pixels at
// silhouettes are taken apart into what they show of each surface, and what is hidden near silhouettes is
// filled in (depth/hidden.h). What a flat pixel leaves uncovered (alpha below 1) lies at the far end as
// emptiness: covered, transparent black.
CocSamples completed(const Input& input);

}  // namespace petzval::engine
