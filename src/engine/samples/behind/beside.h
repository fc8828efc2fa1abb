// The surface beside a pixel, where it lies a little farther.
#pragma once

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/smooth.h"

#include <optional>

namespace petzval::engine {

// A hair on a coat is in front of it by a step too small for a silhouette, but its blur is wider than the
// coat's, so some rays of the lens pass the hair. They reach the coat, which continues behind the hair, and
// nothing behind the coat. Returns the farthest surface of the four pixels beside (x, y) if it is farther by
// more than half a step and does not continue the slope of (x, y). Requires: (x, y) touches no silhouette.
std::optional<HiddenGuess> surface_beside(const KnownSurfaces& known, View<const float> coc_px, int x, int y);

}  // namespace petzval::engine
