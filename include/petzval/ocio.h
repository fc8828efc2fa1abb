// Displays and views of OpenColorIO, by the config that $OCIO names. Optional component petzval::ocio; the
// library itself knows nothing of it.
#pragma once

#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <string>
#include <vector>

namespace petzval {

struct OcioView {
    std::string display, view;  // empty: the config's default, and that display's
    // What the config calls scene-linear Rec.709 light. Empty: found by the role aces_interchange, to which
    // the way is known; else by usual names; else the role scene_linear is taken for it, with a warning.
    std::string space;
};

struct OcioPicture {
    Picture codes;  // r, g, b as the display wants them, 0…1 where it can show them
    std::string display, view, space;
    std::vector<std::string> warnings;
};

// `picture`: scene-linear Rec.709, premultiplied, shown over black; NaN counts as 0, infinite light as 65504.
// Drawn by `workers`, those of a host, or by our own `threads` (0: all); the same for any number. Errors:
// InvalidArgument ($OCIO is not set; the config has no such display, view or space: the message lists those
// it has), InvalidFile (the config cannot be used).
PETZVAL_API Result<OcioPicture> ocio_codes(View<const Rgba> picture, const OcioView& view = {},
                                           int threads = 0, Workers* workers = nullptr);

}  // namespace petzval
