// Pixels of flat EXR parts, as float.
#pragma once

#include "petzval/image.h"
#include "petzval/result.h"

#include "files/channels/channel_choice.h"
#include "files/exr/file.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace petzval {

// Replaces infinity by the largest half, NaN and -infinity (light is not negative) by 0; false if there was
// nothing to replace.
inline bool made_finite(float& v) {
    if (std::isfinite(v)) return false;
    v = v > 0 ? kLargestHalf : 0;
    return true;
}

// Destination of a channel's samples: the first pixel of the part's data window, and the steps between pixels
// and rows in floats.
struct FloatTarget {
    std::string channel;
    float* first = nullptr;
    std::ptrdiff_t pixel_step = 1, row_step = 0;
};
// All channels in one pass over the part. Half and uint samples are converted.
Status read_floats(const ExrFile& exr, std::size_t part, const std::vector<FloatTarget>& targets);

// Colour of the chosen channels, alpha 1 where there is none; `depth`, if given, is filled from a channel of
// the same part in the same pass.
Status read_colour(const ExrFile& exr, const ColourChoice& choice, Picture& colour, Plane* depth,
                   const std::string& depth_channel);

// The chosen depth over its part's data window.
Result<Plane> read_depth(const ExrFile& exr, const DepthChoice& choice);

// True if a part has worldToCamera, which makes depth of positions.
bool has_camera_matrix(const ExrFile& exr);

// `plane` covers `from`; returns what of it lies in `to`, +infinity (a miss) where it covers nothing.
Plane pasted(const Plane& plane, const Rect& from, const Rect& to);
// Adds a line if depth over `window` misses a part of the picture.
void note_missing_depth(const Rect& window, const Rect& picture, std::vector<std::string>& detected);

}  // namespace petzval
