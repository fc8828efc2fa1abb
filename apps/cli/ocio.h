// --ocio: a display and view of the config that $OCIO names, in place of our own tone curve and transfer.
#pragma once

#include "petzval/develop.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include "flags.h"
#include "output.h"

#include <optional>
#include <string>
#include <vector>

namespace petzval::cli {

struct OcioFlags {
    std::string view;  // "DISPLAY,VIEW", "DISPLAY" or "default"; empty: not asked for
    std::string space;

    void add_to(Verb& verb);
    // Throws UsageError, also for flags of what --ocio takes the place of.
    void check(const DevelopFlags& develop, std::optional<Transfer> transfer) const;
    void add_to(MadeWith& made) const;
    bool is_on() const { return !view.empty(); }
    // Whether the config has what was asked for; errors as of show().
    Status try_out() const;
    // From scene-linear light to what the display wants; `settings` are then what is left to do to it: dither
    // and rounding. `used`: a line that says what was taken. Errors: those of ocio_codes(); InvalidArgument
    // where this program was built without OpenColorIO.
    Status show(Picture& light, DevelopSettings& settings, std::string& used,
                std::vector<std::string>& warnings) const;

private:
    Result<Picture> codes(View<const Rgba> light, int threads, std::string& used,
                          std::vector<std::string>& warnings) const;
};

}  // namespace petzval::cli
