// Rendered::mask: where the effect is limited.
#pragma once

#include "petzval/defocus.h"

#include "base/parallel.h"

namespace petzval {

// Limits the effect by the mask, in a report that holds `pixels` of the frame's pictures and in its layers.
// Buffers that are shown instead of the picture stay as they are.
void limit_by_mask(DefocusReport& report, const Rendered& rendered, const Rect& pixels, Workers& workers);

}  // namespace petzval
