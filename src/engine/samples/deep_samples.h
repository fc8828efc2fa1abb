// Deep pixels as engines see them: thin samples with radii instead of depths.
#pragma once

#include "petzval/deep.h"
#include "petzval/workers.h"

#include "engine/waist/engine.h"

#include <functional>

namespace petzval::engine {

// The samples of a deep picture, nearest first. Overlapping volumes are separated. Thick ones are cut
// so that the radius changes by at most a pixel or an eleventh from one part to the next; each part has its
// middle radius. Pixels of very many samples are summed at that spacing (image/deep_pixel.h). `radius_px`
// never falls with depth. Colours are made finite; a depth that is NaN, or not positive unless depth_is_coc,
// is infinite.
CocSamples deep_samples(const DeepPicture& deep, const std::function<float(float)>& radius_px,
                        bool depth_is_coc, Workers& workers);

}  // namespace petzval::engine
