// Deep pixels as engines see them: thin samples with radii instead of depths.
#pragma once

#include "petzval/deep.h"
#include "petzval/workers.h"

#include "engine/waist/engine.h"

#include <functional>
#include <variant>

namespace petzval::engine {

// The meaning of a stated depth, by which it becomes the signed radius of a blur. A radius never falls with
// depth.
struct StatedMetres {  // planar; a depth that is not above 0 is a miss
    std::function<float(float)> radius_px;
};
struct StatedRadii {  // signed; only NaN is a miss
    std::function<float(float)> radius_px;
};
using StatedDepth = std::variant<StatedMetres, StatedRadii>;

inline const std::function<float(float)>& radius_of(const StatedDepth& meaning) {
    return std::visit([](const auto& m) -> const std::function<float(float)>& { return m.radius_px; },
                      meaning);
}
inline bool is_in_radii(const StatedDepth& meaning) { return std::holds_alternative<StatedRadii>(meaning); }

// The samples of a deep picture, nearest first. Overlapping volumes are separated. Thick ones are cut
// so that the radius changes by at most a pixel or an eleventh from one part to the next; each part has its
// middle radius. Pixels of very many samples are summed at that spacing (image/deep_pixel.h). Colours are
// made finite; a miss is infinitely far.
CocSamples deep_samples(const DeepPicture& deep, const StatedDepth& meaning, Workers& workers);

}  // namespace petzval::engine
