// --ocio: a display and view of the config in $OCIO, instead of our tone curve and transfer.
#pragma once

#include "petzval/develop.h"
#include "petzval/image.h"
#include "petzval/result.h"
#include "petzval/shot_run.h"

#include "flags/flags.h"
#include "output.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct OcioFlags {
    std::string view;  // "DISPLAY,VIEW", "DISPLAY" or "default"; empty: not asked for
    std::string space;

    void add_to(Verb& verb);
    bool is_on() const { return !view.empty(); }
    // Checks that the config has the display and view; errors as show().
    Status try_out() const;
    // Converts scene-linear light to the display's values; `settings` then hold the remaining steps: dither
    // and rounding. `used`: a line that names the display and view. Errors: those of ocio_codes();
    // InvalidArgument if this program was built without OpenColorIO.
    Status show(Picture& light, DevelopSettings& settings, std::string& used,
                std::vector<std::string>& warnings) const;
    // The host with show() as its display, where --ocio was given.
    ShotRunHost display(FrameLoopHost host) const;
};

}  // namespace petzval::cli
