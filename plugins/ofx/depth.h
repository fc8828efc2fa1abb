// Depth of a frame: from a clip, a file or alpha, as planar metres.
#pragma once

#include "petzval/image.h"
#include "petzval/result.h"

#include "images.h"
#include "params.h"

#include <string>

namespace petzval::plugin {

// The names of the clips.
inline constexpr const char* kDepthClip = "Depth";
inline constexpr const char* kPlateClip = "Plate";
inline constexpr const char* kPlateDepthClip = "PlateDepth";
inline constexpr const char* kMaskClip = "Mask";

// One value for each pixel of Source, top row first: metres, or radii in pixels.
struct DepthOfFrame {
    Plane values;
    bool are_radii = false;
    std::string doubt;  // one line if no channel of the depth file is named like depth
};

struct DepthQuestion {
    ofx::Effect* effect;
    ofx::Time time;
    const Values* values;
    const LentImage* source;
    const FrameOfHost* frame;
    ofx::Point scale;
};

// Errors: InvalidArgument where nothing gives depth, or the range of the kind is missing; InvalidFile. They
// name fields of the library (in_labels()).
Result<DepthOfFrame> depth_of(const DepthQuestion& question);
// Depth of the clip PlateDepth by the same kind and unit.
Result<DepthOfFrame> plate_depth_of(const DepthQuestion& question);
// A share for each pixel of Source, 0 beyond the mask; empty where no mask is connected.
Plane mask_of(const DepthQuestion& question);

}  // namespace petzval::plugin
