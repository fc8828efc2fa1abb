#include "curve_edit.h"

#include "petzval/lens.h"

#include "fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace petzval::view {
namespace {

constexpr double kReach = 0.25;  // of the pupil's radius

// Zones rise from the axis to the rim, and every shift is a number: that of the nearest zone that has one.
void complete(LongitudinalAberrationFacts& curves) {
    if (curves.zones.size() < 2 || curves.shift_mm.empty()) {
        curves.zones.clear();
        for (int i = 0; i <= 12; ++i) curves.zones.push_back(i / 12.0);
        curves.wavelengths_um = {0.464, 0.549, 0.611};
        curves.shift_mm.assign(3, std::vector<double>(curves.zones.size(), 0.0));
    }
    for (auto& curve : curves.shift_mm) {
        double last = 0;
        for (double& shift : curve) shift = last = std::isfinite(shift) ? shift : last;
    }
    if (curves.zones.front() > 0) {
        curves.zones.insert(curves.zones.begin(), 0.0);
        for (auto& curve : curves.shift_mm) curve.insert(curve.begin(), curve.front());
    }
    curves.zones.front() = 0;
    curves.zones.back() = std::max(curves.zones.back(), 1.0);
}

std::string listed(const std::vector<double>& numbers, double scale) {
    std::string text;
    for (const double number : numbers) text += (text.empty() ? "" : ", ") + text_of(number * scale, 9);
    return "[" + text + "]";
}

}  // namespace

Result<BentLens> bent_lens_of(const LensChoice& choice) {
    const auto lens = Lens::open(choice);
    if (!lens) return lens.error();
    const auto facts = lens_facts(*lens);
    BentLens bent{.focal_length_mm = 50, .f_number = 1.4, .curves = {}};
    if (facts && facts->efl_mm > 0 && facts->f_number > 0) {
        bent.focal_length_mm = facts->efl_mm, bent.f_number = facts->f_number;
        if (facts->sensor_width_mm > 0) bent.sensor_width_mm = facts->sensor_width_mm;
        bent.curves = facts->longitudinal_aberration;
    }
    complete(bent.curves);
    return bent;
}

void bend(BentLens& lens, double zone, double by_mm, double only_nm) {
    LongitudinalAberrationFacts& curves = lens.curves;
    std::size_t nearest = 0;
    for (std::size_t w = 1; w < curves.wavelengths_um.size(); ++w)
        if (std::abs(1000 * curves.wavelengths_um[w] - only_nm) <
            std::abs(1000 * curves.wavelengths_um[nearest] - only_nm))
            nearest = w;
    const double most_mm = 0.2 * lens.focal_length_mm;
    for (std::size_t w = 0; w < curves.shift_mm.size(); ++w) {
        if (only_nm > 0 && w != nearest) continue;
        for (std::size_t z = 0; z < curves.zones.size(); ++z) {
            const double away = (curves.zones[z] - zone) / kReach;
            double& shift = curves.shift_mm[w][z];
            shift = std::clamp(shift + by_mm * std::exp(-away * away), -most_mm, most_mm);
        }
    }
}

std::string lens_file_text(const BentLens& lens) {
    const double rim_mm = 0.5 * lens.focal_length_mm / lens.f_number;
    std::string text = "{\n  \"id\": \"bent\",\n  \"name\": \"a lens whose curves were bent by hand\",\n";
    text += "  \"units\": \"mm\",\n  \"focal_length_mm\": " + text_of(lens.focal_length_mm, 9) +
            ",\n  \"f_number\": " + text_of(lens.f_number, 9) +
            ",\n  \"sensor_width_mm\": " + text_of(lens.sensor_width_mm, 9) + ",\n";
    text += "  \"pupil_height\": " + listed(lens.curves.zones, rim_mm) + ",\n  \"curves\": [\n";
    for (std::size_t w = 0; w < lens.curves.shift_mm.size(); ++w)
        text += "    {\"wavelength_nm\": " + text_of(1000 * lens.curves.wavelengths_um[w], 9) +
                ", \"shift\": " + listed(lens.curves.shift_mm[w], 1) +
                (w + 1 < lens.curves.shift_mm.size() ? "},\n" : "}\n");
    return text + "  ]\n}\n";
}

}  // namespace petzval::view
