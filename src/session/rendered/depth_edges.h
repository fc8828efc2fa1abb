// Soft silhouettes of a frame's depth, made hard.
#pragma once

#include "petzval/depth.h"
#include "petzval/rendered.h"
#include "petzval/workers.h"

#include <string>

namespace petzval {

// Depth, or radii, without ramps. plane is empty where the given one stays as it is.
struct HardDepth {
    Plane plane;
    std::string what_was_done;

    // The same frame with this depth, while `plane` lasts.
    Rendered of(Rendered rendered) const;
};

// Deep pictures are left as they are.
HardDepth hard_depth(const Rendered& rendered, DepthEdges edges, Workers& workers);

}  // namespace petzval
