#include "kernel/ideal_lens.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

// A chord of the outline may leave its arc by this much on the image.
constexpr double kChordTolerancePx = 2e-4;

PointSpread normalised(CoverageBuffer<double>& coverage) {
    const Rect extent = coverage.extent();
    PointSpread spread{extent, Image<Rgba>::uninitialised(extent.width(), extent.height()), true};
    std::vector<const double*> rows;
    double sum = 0;
    for (int j = 0; j < extent.height(); ++j) {
        rows.push_back(coverage.resolve_row(j));
        for (int i = 0; i < extent.width(); ++i) sum += rows.back()[i];
    }
    for (int j = 0; j < extent.height(); ++j)
        for (int i = 0; i < extent.width(); ++i) {
            // Running sums leave a rounding residue where nothing is covered.
            const double weight = rows[std::size_t(j)][i] / sum;
            const float w = weight > 1e-12 ? float(weight) : 0.0f;
            spread.weights(i, j) = {w, w, w, w};
        }
    return spread;
}

}  // namespace

PointSpread IdealLens::point_spread(double coc_radius_px, FieldPosition field) const {
    const double radius = std::abs(coc_radius_px);
    std::vector<Point> outline = pupil_.outline(field, kChordTolerancePx / std::max(radius, 1.0));
    Point low{}, high{};
    for (Point& p : outline) {
        p = {coc_radius_px * p.x, coc_radius_px * pixel_aspect_ * p.y};
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const Rect extent = pixels_touched(low, high);
    if (extent.width() == 1 && extent.height() == 1) return {extent, {1, 1, Rgba{1, 1, 1, 1}}, true};
    CoverageBuffer<double> coverage(extent);
    coverage.add_polygon(outline, 1);
    return normalised(coverage);
}

std::vector<PupilRay> IdealLens::rays(int count, FieldPosition field, std::uint64_t seed) const {
    const float weight = 1 / float(count);
    std::vector<PupilRay> rays;
    for (const PupilPoint& p : spread_evenly(pupil_.outline(field, 1e-5), count, seed))
        rays.push_back(
            {float(p.place.x), float(p.place.y * pixel_aspect_), 0, 0, {weight, weight, weight, weight}});
    return rays;
}

double IdealLens::reach_px(double coc_radius_px) const {
    return std::abs(coc_radius_px) * std::max(1.0, pixel_aspect_);
}

}  // namespace petzval::kernel
