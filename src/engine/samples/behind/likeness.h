// Compares two visible pixels that may be pieces of one surface behind an occluder.
#pragma once

#include "engine/samples/behind/search.h"

namespace petzval::engine {

// High where the pixels around two ends of a search could be two pieces of one surface, and higher where an
// edge runs from one to the other: plain pieces look alike everywhere. to_a, to_b: directions from the hidden
// pixel.
float likeness(const KnownSurfaces& known, const Found& a, Direction to_a, const Found& b, Direction to_b);

}  // namespace petzval::engine
