#include "kernel/lenses/ideal_lens.h"

#include "base/cancel.h"
#include "kernel/draw/ray_set.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

// A chord of the outline may leave its arc by this much on the image.
constexpr double kChordTolerancePx = 2e-4;

PointSpread share_of_pixels(CoverageBuffer<double>& coverage) {
    const Rect extent = coverage.extent();
    PointSpread spread{extent, Image<Rgba>::uninitialised(extent.width(), extent.height()), true};
    std::vector<const double*> rows;
    double sum = 0;
    for (int j = 0; j < extent.height(); ++j) {
        check_cancelled();
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
    PointSpread spread = share_of_pixels(coverage);
    if (pupil_.has_texture()) dim(spread, coc_radius_px);
    return spread;
}

// Dims by the texture's mean over each pixel.
void IdealLens::dim(PointSpread& spread, double coc_radius_px) const {
    const double half = 0.5 / std::abs(coc_radius_px);
    for (int y = spread.extent.y0; y < spread.extent.y1; ++y) {
        check_cancelled();
        for (int x = spread.extent.x0; x < spread.extent.x1; ++x) {
            const Point place{x / coc_radius_px, y / (coc_radius_px * pixel_aspect_)};
            Rgba& w = spread.weights(x - spread.extent.x0, y - spread.extent.y0);
            w *= float(pupil_.transmission(place, half));
        }
    }
    normalise(spread);
}

std::vector<PupilRay> IdealLens::rays(int count, FieldPosition field, std::uint64_t seed) const {
    return spread_rays(
        pupil_.outline(field, 1e-5), colour::spectral_bands(1), count, seed,
        [this](std::size_t, Point pupil) {
            return RayLanding{{pupil.x, pupil.y * pixel_aspect_}, {}, pupil_.transmission(pupil, 1.0 / 256)};
        });
}

std::function<Point(Point)> IdealLens::landing(double, double coc_radius_px, FieldPosition) const {
    return [c = coc_radius_px, tall = coc_radius_px * pixel_aspect_](Point p) {
        return Point{c * p.x, tall * p.y};
    };
}

double IdealLens::reach_px(double coc_radius_px) const {
    return std::abs(coc_radius_px) * std::max(1.0, pixel_aspect_);
}

}  // namespace petzval::kernel
