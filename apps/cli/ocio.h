// --ocio: a display and view of the config that $OCIO names, in place of our own tone curve and transfer.
#pragma once

#include "petzval/image.h"
#include "petzval/result.h"

#include "flags.h"

#include <string>
#include <vector>

namespace petzval::cli {

struct OcioFlags {
    std::string view;  // "DISPLAY,VIEW", "DISPLAY" or "default"; empty: not asked for
    std::string space;

    void add_to(Verb& verb);
    void check() const;  // throws UsageError
    bool is_on() const { return !view.empty(); }
    // What the display wants, from scene-linear light. `used`: a line that says what was taken. Errors: those
    // of ocio_codes(); Unsupported where this program was built without OpenColorIO.
    Result<Picture> codes(View<const Rgba> light, int threads, std::string& used,
                          std::vector<std::string>& warnings) const;
};

}  // namespace petzval::cli
