// Texts of `inspect` about a picture's light and the range in focus.
#pragma once

#include "petzval/camera.h"
#include "petzval/dynamic_range.h"

#include "console/report.h"

#include <iosfwd>

namespace petzval::cli {

void describe_range(const DynamicRange& range, std::ostream& out);
Json range_json(const DynamicRange& range);

void describe_limits(const FocusLimits& limits, double permissible_radius_px, std::ostream& out);
Json limits_json(const FocusLimits& limits, double permissible_radius_px);

}  // namespace petzval::cli
