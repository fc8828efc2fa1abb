// A picture as a lens with distortion records it: what stands at r half diagonals from the middle of the
// display window moves to r (1 + amount r^2), so that discs stretch by (1 + 3 amount r^2) along that
// direction and by (1 + amount r^2) across it, as petzval/lens_choice.h says.
//
// Beyond a side of the picture that ends inside the frame there is nothing. Beyond other sides the scene
// continues, unknown: the picture's mirror image stands for it. Where barrel distortion shows nothing at all,
// the picture is empty.
#pragma once

#include "petzval/image.h"
#include "petzval/place.h"
#include "petzval/workers.h"

namespace petzval {

// `seen`: the pixels of place.data_window, counted from its corner, that `picture` has. Of the same size.
// Requires: -0.3 <= amount <= 0.3; `seen` holds before_distortion() of all pixels that count.
Picture distorted(const Picture& picture, const Rect& seen, const Place& place, double amount,
                  Workers& workers);

// The same of a layer of that picture, of its size: by straight lines where the picture's own sampling was
// held back, so that layers which sum to the picture do so still. is_light: as in ColourLayer; alpha is the
// picture's.
Picture distorted_beside(const Picture& picture, const Picture& layer, bool is_light, const Rect& seen,
                         const Place& place, double amount, Workers& workers);

// The pixels of the data window, counted from its corner, that these show: their least rectangle, with those
// that lie between it and its neighbours.
Rect before_distortion(const Rect& pixels, const Place& place, double amount);

// The missing overscan, in pixels: distortion shows the scene that far beyond the widest side of the picture.
int missing_beyond_px(const Place& place, double amount);

}  // namespace petzval
