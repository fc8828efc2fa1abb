// Texts of `inspect` about a picture's light and the range in focus.
#pragma once

#include "petzval/camera.h"
#include "petzval/dynamic_range.h"

#include <iosfwd>

namespace petzval::cli {

void describe_range(const DynamicRange& range, std::ostream& out);
void describe_limits(const FocusLimits& limits, double permissible_radius_px, std::ostream& out);

}  // namespace petzval::cli
