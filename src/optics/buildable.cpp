#include "optics/buildable.h"

#include "optics/paraxial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace petzval::optics {
namespace {

constexpr int kSteps = 64;

std::string two_surfaces(std::size_t front) {
    return "surfaces " + std::to_string(front + 1) + " and " + std::to_string(front + 2);
}

std::string millimetres(double mm) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g mm", mm);
    return text.data();
}

// Distance between two surfaces at a height.
double gap(const LensAtWavelength& lens, std::size_t front, double height) {
    const auto& s = lens.surfaces;
    return s[front].thickness_mm + s[front + 1].sag_mm(height) - s[front].sag_mm(height);
}

std::vector<double> clear_radii(const Prescription& lens, const LensAtWavelength& at,
                                const FirstOrder& first) {
    const ParaxialTrace beam = trace_paraxial(at, {first.entrance_pupil_diameter_mm / 2, 0});
    std::vector<double> radii;
    for (std::size_t i = 0; i < lens.surfaces.size(); ++i) {
        const double stated = lens.surfaces[i].clear_radius_mm;
        radii.push_back(std::isfinite(stated) ? stated : std::abs(beam.height_mm[i]));
    }
    return radii;
}

std::string doubt_about(const LensAtWavelength& at, std::size_t front, double radius, bool is_glass) {
    for (int k = 0; k <= kSteps; ++k) {
        const double height = radius * k / kSteps, between = gap(at, front, height);
        if (!std::isfinite(between))
            return two_surfaces(front) + ": a clear radius of " + millimetres(radius) +
                   " lies beyond the sphere";
        if (between < -1e-6 * radius)
            return two_surfaces(front) + " overlap from " + millimetres(height) + " off the axis" +
                   (k == 0 ? " on: the distance is negative" : " outwards");
    }
    const double edge = gap(at, front, radius);
    if (is_glass && edge < kThinEdge * 2 * radius)
        return "the edge between " + two_surfaces(front) + " is only " + millimetres(edge) + " thick at " +
               millimetres(2 * radius) + " diameter";
    return "";
}

}  // namespace

std::vector<std::string> build_doubts(const Prescription& lens) {
    std::vector<std::string> doubts;
    const auto first = first_order(lens, lens.primary_um);
    if (!first) return doubts;
    const LensAtWavelength at = at_wavelength(lens, lens.primary_um);
    const std::vector<double> radii = clear_radii(lens, at, *first);
    for (std::size_t i = 0; i + 1 < lens.surfaces.size(); ++i) {
        // A stop is a plane that glass may reach through.
        const bool at_stop = int(i) == lens.stop || int(i) + 1 == lens.stop;
        const bool is_glass = !lens.surfaces[i].after.is_air();
        if (at_stop && !is_glass) continue;
        const std::string doubt = doubt_about(at, i, std::min(radii[i], radii[i + 1]), is_glass);
        if (!doubt.empty()) doubts.push_back(doubt);
    }
    return doubts;
}

}  // namespace petzval::optics
