// Motion of surfaces between two pictures, estimated from their colours and depths alone.
#pragma once

#include "petzval/image.h"
#include "petzval/motion.h"
#include "petzval/workers.h"

namespace petzval::shot {

struct DepthPicture {
    View<const Rgba> colour;
    View<const float> depth;
    Rect window;  // its pixels in the display window
};

// The way of each pixel of `from` to the place of its surface in `to`. Squares of pixels are matched from
// coarse to fine, each by the pixels of one surface, and motion is smoothed along surfaces; so what `to`
// hides moves as the visible rest of its surface does. NaN: not known, beside things narrower than four
// pixels. Requires: colour and depth of a picture have one size.
Image<PixelMove> optical_flow(const DepthPicture& from, const DepthPicture& to, Workers& workers);

}  // namespace petzval::shot
