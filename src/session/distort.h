// A picture as a lens with distortion records it: what stands at r half diagonals from the middle of the
// display window moves to r (1 + amount r^2), so that discs stretch by (1 + 3 amount r^2) along that
// direction and by (1 + amount r^2) across it, as petzval/lens_choice.h says.
#pragma once

#include "petzval/image.h"
#include "petzval/place.h"
#include "petzval/workers.h"

namespace petzval {

// Of the same size. Where something from outside of the picture would be seen, its border is repeated.
// Requires: -0.3 <= amount <= 0.3.
Picture distorted(const Picture& picture, const PixelField& field, double amount, Workers& workers);

// The pixels that these show: their least rectangle, with those that lie between it and its neighbours.
Rect before_distortion(const Rect& pixels, const PixelField& field, double amount);

}  // namespace petzval
