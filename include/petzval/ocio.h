// Displays and views of the OpenColorIO config in $OCIO. Optional component petzval::ocio; the library
// itself does not use it.
#pragma once

#include "petzval/develop.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <string>
#include <vector>

namespace petzval {

struct OcioView {
    std::string display, view;  // empty: the config's default, and that display's
    // The config's colour space of scene-linear Rec.709 light. Empty: the space is derived from the role
    // aces_interchange; without that role from common names; without those the role scene_linear is used,
    // with a warning.
    std::string space;
};

struct OcioPicture {
    Picture codes;  // r, g, b for the display, 0…1 inside its range
    std::string display, view, space;
    std::vector<std::string> warnings;
};

// Converts a picture to the codes of an OCIO display. `picture` is scene-linear Rec.709, premultiplied, and
// is shown over black; NaN counts as 0, infinite light as 65504. `workers` are a host's threads; without
// them, `threads` of our own run (0: all). The result is the same for any number of threads. Errors:
// InvalidArgument ($OCIO is not set; the config has no display, view or space of that name: the message lists
// the available ones), InvalidFile (the config cannot be used).
PETZVAL_API Result<OcioPicture> ocio_codes(View<const Rgba> picture, const OcioView& view = {},
                                           int threads = 0, Workers* workers = nullptr);

// Parses "DISPLAY,VIEW", "DISPLAY", or "default" for the config's own.
PETZVAL_API OcioView ocio_view(const std::string& text);

// Exposes the light and replaces it by ocio_codes(), in the form of ShotRunHost::to_display: `settings` then
// hold the remaining steps, dither and rounding; `used` names display, view and space. Errors: those of
// ocio_codes().
PETZVAL_API Status show_by_ocio(Picture& light, DevelopSettings& settings, const OcioView& view,
                                std::string& used, std::vector<std::string>& warnings);

}  // namespace petzval
