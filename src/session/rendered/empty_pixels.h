// The depth of pixels with neither light nor coverage: renderers and mattes leave any number there.
#pragma once

#include "petzval/rendered.h"
#include "petzval/workers.h"

#include <string>

namespace petzval {

// Depth, or radii, in which empty pixels lie behind everything, so that no engine takes them for occluders.
// plane is empty where the given one stays as it is.
struct EmptyFar {
    Plane plane;
    std::string warning;  // about light without any alpha, and alpha that is not 0 to 1; else empty

    // The same frame with this depth, while `plane` lasts.
    Rendered of(Rendered rendered) const;
};

// Metres become infinite. Radii become the farthest radius of a pixel that is not empty, because the radius
// at infinity is unknown. A picture without alpha above 0 is left as it is, because its black pixels are
// surfaces. Samples of a deep picture are left as they are; engines that use its front view see the depth.
EmptyFar empty_far(const Rendered& rendered, Workers& workers);

}  // namespace petzval
