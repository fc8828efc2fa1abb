// The hits of a search that belong to one surface.
#pragma once

#include "engine/samples/behind/search.h"

namespace petzval::engine {

// True if each of two hits lies on the other's plane, to step_px. 1/z of a plane is an affine function of the
// place in the picture, and so is the signed radius. A box may stand on a floor whose radii differ as much as
// those of box and floor, but the planes differ.
bool on_one_plane(const Found& a, const Found& b);

// Marks the hits on the surface of the farthest hit, and only these. The surface may bend from hit to hit.
// Returns false if nothing was found.
bool mark_farthest_surface(Hits& hits);

}  // namespace petzval::engine
