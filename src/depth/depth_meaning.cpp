// Depth that is not a distance: radii, and whole numbers.
#include "petzval/depth.h"

#include <cmath>
#include <string>

namespace petzval {

Result<DepthReport> depth_to_radii_px(View<float> depth, const DepthSettings& settings) {
    const bool ranged = settings.range_near && settings.range_far;
    const double near = ranged ? *settings.range_near : 0, far = ranged ? *settings.range_far : 1;
    if (!std::isfinite(near) || !std::isfinite(far) || near == far)
        return Error{ErrorCode::InvalidArgument,
                     "depth.range of depth.kind coc-px needs two different radii in pixels", "depth.range"};
    DepthReport report;
    for (int y = 0; y < depth.height(); ++y)
        for (int x = 0; x < depth.width(); ++x) {
            float& radius = depth(x, y);
            if (ranged) radius = float(near + double(radius) * (far - near));
            if (!std::isfinite(radius)) radius = 0, ++report.non_finite;
        }
    if (report.non_finite > 0)
        report.warnings.push_back(std::to_string(report.non_finite) +
                                  " radii of the depth channel are not finite and count as 0 (sharp)");
    return report;
}

Status check_depth_codes(const DepthSettings& settings, bool kind_given) {
    const bool ranged = settings.range_near && settings.range_far;
    if (settings.kind == DepthKind::CocPx && !ranged)
        return Error{ErrorCode::InvalidArgument,
                     "integer pixels hold no radii in pixels; set depth.range to the radii of black and "
                     "white, in pixels, negative in front of focus",
                     "depth.range"};
    if (settings.kind != DepthKind::Planar || kind_given) return Done{};
    return Error{
        ErrorCode::InvalidArgument,
        "integer pixels are not distances in metres; set their meaning, such as depth.kind inverse "
        "depth.range 1,inf (white is near) or depth.kind normalized depth.range 0.5,20 (black is near)",
        "depth.kind"};
}

}  // namespace petzval
