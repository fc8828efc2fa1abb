// The surface beside a pixel, where it lies a little farther.
#pragma once

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/behind/smooth.h"

#include <optional>

namespace petzval::engine {

// A hair on a coat lies before it by a step too small for a silhouette, and its blur is wider than the
// coat's: some of the lens looks past the hair. There it sees the coat, which continues behind the hair, and
// not what is hidden behind the coat. This is the farthest surface that the four pixels beside (x, y) show,
// if it is farther by more than half a step and does not continue the slope of (x, y). Requires: (x, y)
// touches no silhouette.
std::optional<HiddenGuess> surface_beside(const KnownSurfaces& known, View<const float> coc_px, int x, int y);

}  // namespace petzval::engine
