#include "kernel/lenses/third_order.h"

#include "colour/spectrum.h"
#include "kernel/draw/pupil.h"

namespace petzval::kernel {
namespace {

constexpr double kPrimary_nm = 587.56;
// Units of LensChoice::coma and ::astigmatism, focal lengths (petzval/lens_choice.h).
constexpr double kComaUnit = 0.02, kAstigmatismUnit = 0.01;
constexpr double kFarthest = 0.1;  // focal lengths

// Mean colour of visible light.
double mean_colour() {
    static const double mean = [] {
        double sum = 0;
        for (const colour::SpectralBand& band : colour::spectral_bands(31))
            sum += band.luminance * colour_place(band.wavelength_nm);
        return sum;
    }();
    return mean;
}

}  // namespace

double colour_place(double wavelength_nm) {
    const auto axis = [](double nm) { return 1e6 / (nm * nm); };
    constexpr double kF_nm = 486.13, kC_nm = 656.27;
    return (axis(wavelength_nm) - axis(kPrimary_nm)) / (axis(kF_nm) - axis(kC_nm));
}

// A focus moved by d away from the lens throws the rim's rays by -d/(2 N). A wave W of spherical aberration,
// W rho^4, throws them by 8 N W rho^3; balanced in the mean square by -2/3 of that on rho.
ThirdOrder::ThirdOrder(const LensChoice& choice, const Mount& mount, double focal_length) {
    const AddedAberrations& added = choice.added;
    const Camera& camera = mount.camera;
    const double rim = 0.5 / camera.f_number, per_mm = focal_length / camera.focal_length_mm;
    coma = choice.coma * kComaUnit * rim * rim * focal_length;
    astigmatism = choice.astigmatism * kAstigmatismUnit * (rim * focal_length);
    const double opened = added.at_f_number > 0 ? added.at_f_number / camera.f_number : 1;
    spherical =
        8 * camera.f_number * added.spherical_waves * std::pow(opened, 4) * kPrimary_nm * 1e-6 * per_mm;
    axial_colour = -added.axial_colour_mm * rim * per_mm;
    curvature = -added.field_curvature_mm * rim * per_mm;
    lateral_colour = 0.01 * added.lateral_colour_percent * corner_tangent(mount) * focal_length;
    if (choice.focus_mode == FocusMode::Best) refocus = -2.0 / 3 * spherical - axial_colour * mean_colour();
}

// With direction h and pupil point p, coma is side (2 (h.p) p + p^2 h), and astigmatism bend (p - 2 (h.p) h).
Displacement ThirdOrder::polynomial(double field, double colour, Point outward) const {
    const double even = refocus + axial_colour * colour + curvature * field * field;
    const double bend = astigmatism * field * field, side = coma * field;
    Displacement d;
    const auto [x, y] = outward;
    d.along[place_of_power(0, 0)] = lateral_colour * field * colour * x;
    d.along[place_of_power(1, 0)] = even - bend * (x * x - y * y);
    d.along[place_of_power(3, 0)] = d.along[place_of_power(1, 2)] = spherical;
    d.along[place_of_power(2, 0)] = 3 * side * x, d.along[place_of_power(0, 2)] = side * x;
    d.across[place_of_power(0, 1)] = even + bend * (x * x - y * y);
    d.across[place_of_power(2, 1)] = d.across[place_of_power(0, 3)] = spherical;
    d.across[place_of_power(1, 1)] = 2 * side * x;
    if (y == 0) return d;
    d.is_skew = true;
    d.along_odd[place_of_power(0, 1)] = -2 * bend * x * y;
    d.along_odd[place_of_power(1, 1)] = 2 * side * y;
    d.across_even[place_of_power(0, 0)] = lateral_colour * field * colour * y;
    d.across_even[place_of_power(1, 0)] = -2 * bend * x * y;
    d.across_even[place_of_power(2, 0)] = side * y;
    d.across_even[place_of_power(0, 2)] = 3 * side * y;
    return d;
}

double ThirdOrder::reach() const {
    return std::abs(spherical) + 3 * std::abs(coma) + std::abs(astigmatism) + std::abs(curvature) +
           std::abs(refocus) + kFarthestColour * (std::abs(axial_colour) + std::abs(lateral_colour));
}

bool adds_aberrations(const LensChoice& choice) {
    AddedAberrations none;
    none.at_f_number = choice.added.at_f_number;
    return choice.coma != 0 || choice.astigmatism != 0 || choice.added != none;
}

Status check_third_order(const LensChoice& choice, const Mount& mount) {
    const ThirdOrder sizes(choice, mount, 1);
    const struct {
        const char* field;
        double size;
    } all[] = {{"lens.added_spherical_waves", sizes.spherical},
               {"lens.added_axial_colour_mm", sizes.axial_colour},
               {"lens.added_field_curvature_mm", sizes.curvature}};
    for (const auto& [field, size] : all)
        if (!(std::abs(size) <= kFarthest))
            return Error{ErrorCode::InvalidArgument,
                         std::string(field) +
                             " moves rays at the rim of the pupil by more than a tenth of the focal length; "
                             "give less, or a smaller aperture",
                         field};
    return Done{};
}

}  // namespace petzval::kernel
