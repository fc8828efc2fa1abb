// The lens of a command.
#pragma once

#include "petzval/lens.h"

#include "flags.h"

#include <optional>
#include <string>

namespace petzval::cli {

struct LensFlags {
    std::string name = "ideal";
    std::optional<int> blades;
    std::optional<FocusMode> focus_mode;
    std::optional<double> rotation_deg, curvature, squeeze, cats_eye;

    void add_to(Verb& verb);
    void check() const;  // throws UsageError for flags that would have no effect
    LensChoice choice() const;
};

}  // namespace petzval::cli
