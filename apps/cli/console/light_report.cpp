#include "console/light_report.h"

#include "flags/values.h"

#include <ostream>

namespace petzval::cli {

void describe_range(const DynamicRange& range, std::ostream& out) {
    out << "light\n  luminance percentiles of lit pixels: p5 (shadow) " << plain(range.shadow, 3)
        << ", p50 (middle) " << plain(range.middle, 3) << ", p90 (diffuse) " << plain(range.diffuse, 3)
        << ", p99.9 (specular) " << plain(range.specular, 3) << "; brightest " << plain(range.brightest, 4)
        << "\n  diffuse over shadow " << plain(range.diffuse_over_shadow_stops, 3)
        << " stops, specular over diffuse " << plain(range.specular_over_diffuse_stops, 3) << " stops\n"
        << (range.comparison.empty() ? "" : "  diffuse is " + range.comparison + "\n") << "  "
        << plain(100 * range.clipped_share, 3) << " % clipped, " << plain(100 * range.black_share, 3)
        << " % without light\n";
}

void describe_limits(const FocusLimits& limits, double permissible_radius_px, std::ostream& out) {
    out << "in focus (blur radius up to " << plain(permissible_radius_px) << " px)\n  "
        << plain(limits.near_m) << " m to " << plain(limits.far_m) << (limits.far_m < 1e30 ? " m" : "")
        << "; hyperfocal distance " << plain(limits.hyperfocal_m) << " m\n";
}

}  // namespace petzval::cli
