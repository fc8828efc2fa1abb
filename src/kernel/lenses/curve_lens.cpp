#include "kernel/lenses/curve_lens.h"

#include "kernel/draw/mesh_kernel.h"
#include "kernel/draw/ray_set.h"
#include "kernel/draw/ring_kernel.h"
#include "kernel/draw/sector_kernel.h"
#include "kernel/model/gamut.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::kernel {
namespace {

constexpr int kLadder[] = {1, 7, 15, 31, 62, 124, 248};
// Neighbouring bands may land this far apart before their rims show as separate lines.
constexpr double kBandStepPx = 0.7;
// Bands that all land within this are one.
constexpr double kNoColourPx = 0.02;
// Largest distance of an outline's chords from their arcs.
constexpr double kChordPx = 0.04;
// Light outside carries under 1 % of the luminance; it does not decide how many bands are needed.
// Rays see the pupil's texture through a window of this half width, pupil radii.
constexpr double kRayWidth = 1.0 / 256;
constexpr int kLeastRingBands = 31, kLeastMeshBands = 7, kLeastRayBands = 62;
constexpr double kSeenFrom_nm = 430, kSeenTo_nm = 670;

double focus_of(const CurveSampler& sampler, const LensChoice& choice, double focal_length_mm) {
    switch (choice.focus_mode) {
        case FocusMode::Best:
            return sampler.best_focus();
        case FocusMode::Shift:
            return choice.focus_shift_mm / focal_length_mm;
        case FocusMode::Paraxial:
            break;
    }
    return 0;
}

std::string describe(const AberrationCurves& curves, const Camera& camera) {
    std::string text = curves.name + ": " + curves.description;
    if (camera.f_number < curves.f_number)
        text += " (curves extended to this aperture, which is wider than theirs)";
    return text;
}

double focal_length_px(const Mount& mount) {
    return mount.camera.focal_length_mm / mount.camera.sensor_width_mm * mount.display_width_px;
}

// Shifts are focal lengths; what throws the rim outward shortens its own.
CurveUse use_of(const LensChoice& choice, const Mount& mount) {
    const double rim = 0.5 / mount.camera.f_number;
    const ThirdOrder added(choice, mount, 1);
    return {mount.camera.f_number, choice.spherical, choice.axial_colour, -added.spherical / rim,
            -added.axial_colour / rim};
}

Light weight_of(const colour::SpectralBand& band) { return {band.r, band.g, band.b}; }

}  // namespace

CurveLens::CurveLens(const AberrationCurves& curves, const LensChoice& choice, const Mount& mount)
    : description_(describe(curves, mount.camera)),
      sampler_(curves, use_of(choice, mount)),
      pupil_(choice, mount),
      choice_(choice),
      pixel_aspect_(mount.pixel_aspect),
      aberration_px_(0.5 / mount.camera.f_number * focal_length_px(mount)),
      focus_(focus_of(sampler_, choice, mount.camera.focal_length_mm)),
      added_(choice, mount, focal_length_px(mount)) {
    const auto add_rung = [&](int count) {
        ladder_.emplace_back();
        const int wavelengths = choice.wavelengths > 0 ? count : kLeastWavelengths;
        for (const BandGroup& group : band_groups(count, wavelengths, choice.light))
            ladder_.back().push_back(band_of(group));
    };
    if (choice.wavelengths > 0 || colour::has_lines(choice.light))
        add_rung(std::max(1, choice.wavelengths));
    else
        for (const int count : kLadder) add_rung(count);
    measure_curves();
}

CurveLens::Band CurveLens::band_of(const BandGroup& group) const {
    std::vector<double> mean(sampler_.at(group.sum.wavelength_nm).samples().size(), 0.0);
    double colour = 0;
    for (std::size_t b = 0; b < group.bands.size(); ++b) {
        const ZoneShift shift = sampler_.at(group.bands[b].wavelength_nm);
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += group.say[b] * shift.samples()[i];
        colour += group.say[b] * colour_place(group.bands[b].wavelength_nm);
    }
    return {group.sum, ZoneShift(std::move(mean)), colour};
}

void CurveLens::measure_curves() {
    const std::vector<Band>& bands = ladder_.back();
    const std::size_t samples = bands[0].shift.samples().size();
    for (std::size_t i = 0; i < samples; ++i) {
        const double rho = std::sqrt(double(i) / double(samples - 1));
        const Band* before = nullptr;
        double path = 0;
        for (const Band& band : bands) {
            const double miss = rho * (band.shift.samples()[i] - focus_);
            largest_shift_ = std::max(largest_shift_, std::abs(miss));
            if (band.spectrum.wavelength_nm < kSeenFrom_nm || band.spectrum.wavelength_nm > kSeenTo_nm)
                continue;
            largest_seen_ = std::max(largest_seen_, std::abs(miss));
            if (before) path += rho * std::abs(band.shift.samples()[i] - before->shift.samples()[i]);
            before = &band;
        }
        colour_path_ = std::max(colour_path_, path);
    }
}

const std::vector<CurveLens::Band>& CurveLens::bands_for(int at_least) const {
    const double sidewards_px =
        std::abs(added_.lateral_colour) * (colour_place(kSeenFrom_nm) - colour_place(kSeenTo_nm));
    const double path_px = colour_path_ * aberration_px_ + sidewards_px;
    const double needed = path_px < kNoColourPx ? 1 : std::max(double(at_least), path_px / kBandStepPx);
    for (const std::vector<Band>& rung : ladder_)
        if (double(rung.size()) >= needed) return rung;
    return ladder_.back();
}

Point CurveLens::landing_px(const Band& band, double coc_radius_px, const FieldAxis& axis,
                            Point pupil) const {
    const double area = pupil.x * pupil.x + pupil.y * pupil.y;
    const double scale = here_px(coc_radius_px, axis.size) - aberration_px_ * (band.shift(area) - focus_);
    if (axis.size == 0) return {scale * pupil.x, scale * pupil.y * pixel_aspect_};
    const double stretch = choice_.distortion * axis.size * axis.size;
    const Point landed = added_.landed(scale, axis.to_axis(pupil), axis.size, band.colour);
    const Point image = axis.from_axis({landed.x * (1 + 3 * stretch), landed.y * (1 + stretch)});
    return {image.x, image.y * pixel_aspect_};
}

std::function<Point(Point)> CurveLens::landing(double wavelength_nm, double coc_radius_px,
                                               FieldPosition field) const {
    return [this, band = Band{{}, sampler_.at(wavelength_nm), colour_place(wavelength_nm)}, coc_radius_px,
            axis = FieldAxis(field)](Point pupil) { return landing_px(band, coc_radius_px, axis, pupil); };
}

bool CurveLens::varies_over_field() const {
    return pupil_.varies_over_field() || added_.curvature != 0 || choice_.distortion != 0 ||
           added_.is_lopsided();
}

Mirrors CurveLens::mirrors() const { return pupil_.mirrors(); }

double CurveLens::reach_px(double coc_radius_px) const {
    const double off_axis = 3 * std::abs(added_.coma) + std::abs(added_.astigmatism) +
                            std::abs(added_.curvature) + kFarthestColour * std::abs(added_.lateral_colour);
    const double stretch = std::max(1.0, 1 + 3 * std::abs(choice_.distortion));
    return (std::abs(coc_radius_px) + aberration_px_ * largest_shift_ + off_axis) * stretch *
           std::max(1.0, pixel_aspect_);
}

bool CurveLens::is_same_around_the_axis(FieldPosition field) const {
    const bool on_axis = field.x == 0 && field.y == 0;
    return (on_axis || (!added_.is_lopsided() && choice_.distortion == 0)) && !pupil_.has_texture();
}

bool CurveLens::has_rings(FieldPosition field) const {
    return is_same_around_the_axis(field) && pupil_.is_disc(field) && pixel_aspect_ == 1;
}

PointSpread CurveLens::ring_spread(double coc_radius_px, RingColours colours) const {
    const Rings rings = rings_of(coc_radius_px, kLeastRingBands);
    return ring_kernel(rings.bands, rings.reach_px, colours);
}

PointSpread CurveLens::raw_point_spread(double coc_radius_px, FieldPosition field) const {
    if (!is_same_around_the_axis(field)) return mesh_spread(coc_radius_px, field);
    const double here = here_px(coc_radius_px, FieldAxis(field).size);
    if (has_rings(field)) return ring_spread(here, RingColours::Raw);
    const std::shared_ptr<const RingSweep> sweep = sweep_of(here);
    const std::vector<Point> outline = pupil_.outline(field, kChordPx / std::max(sweep->reach_px(), 4.0));
    if (!is_star_about_axis(outline)) return mesh_spread(coc_radius_px, field);
    return sector_kernel(outline, *sweep, pixel_aspect_);
}

// Places of the picture share the sweep of a radius: the last few are kept. Two threads may make the same.
std::shared_ptr<const RingSweep> CurveLens::sweep_of(double coc_radius_px) const {
    {
        const std::lock_guard lock(sweeps_mutex_);
        for (const auto& [radius, sweep] : sweeps_)
            if (sweep && radius == coc_radius_px) return sweep;
    }
    const Rings rings = rings_of(coc_radius_px, kLeastRingBands);
    auto sweep = std::make_shared<const RingSweep>(rings.bands, rings.reach_px);
    const std::lock_guard lock(sweeps_mutex_);
    sweeps_[next_sweep_++ % sweeps_.size()] = {coc_radius_px, sweep};
    return sweep;
}

PointSpread CurveLens::point_spread(double coc_radius_px, FieldPosition field) const {
    if (has_rings(field))
        return ring_spread(here_px(coc_radius_px, FieldAxis(field).size), RingColours::InGamut);
    PointSpread spread = raw_point_spread(coc_radius_px, field);
    map_into_gamut(spread);
    return spread;
}

CurveLens::Rings CurveLens::rings_of(double coc_radius_px, int least_bands) const {
    Rings rings;
    for (const Band& band : bands_for(least_bands)) {
        const auto landing = [this, coc_radius_px, &band](double area) {
            return std::sqrt(area) * (coc_radius_px - aberration_px_ * (band.shift(area) - focus_));
        };
        const std::size_t last = band.shift.samples().size() - 1;
        for (std::size_t i = 0; i <= last; ++i)
            rings.reach_px = std::max(rings.reach_px, std::abs(landing(double(i) / double(last))));
        rings.bands.push_back({weight_of(band.spectrum), at_each(landing)});
    }
    return rings;
}

PointSpread CurveLens::mesh_spread(double coc_radius_px, FieldPosition field) const {
    const FieldAxis axis(field);
    // Aberrations bend faster across the pupil than they reach.
    const double aberration = aberration_px_ * largest_seen_, coma = 3 * std::abs(added_.coma) * axis.size;
    const double here = std::abs(here_px(coc_radius_px, axis.size));
    const double size = here + aberration + coma, bend = here + 3 * aberration + 4 * coma;
    const MeshPupil pupil = mesh_pupil(pupil_, pupil_.outline(field, mesh_tolerance(bend)), size, bend);
    std::vector<MeshBand> bands;
    for (const Band& band : bands_for(kLeastMeshBands))
        bands.push_back(
            {weight_of(band.spectrum), [&, coc_radius_px](std::span<const Point> points, Point* landed) {
                 for (const Point& p : points) *landed++ = landing_px(band, coc_radius_px, axis, p);
             }});
    return mesh_kernel(pupil, bands);
}

std::vector<PupilRay> CurveLens::rays(int count, FieldPosition field, std::uint64_t seed) const {
    const FieldAxis axis(field);
    const std::vector<Band>& bands = bands_for(kLeastRayBands);
    std::vector<colour::SpectralBand> spectrum;
    for (const Band& band : bands) spectrum.push_back(band.spectrum);
    return spread_rays(pupil_.outline(field, 1e-5), spectrum, count, seed,
                       [&](std::size_t band, Point pupil) {
                           const Point offset = landing_px(bands[band], 0, axis, pupil);
                           // Effect of the radius alone: the landing place is linear in it.
                           return RayLanding{landing_px(bands[band], 1, axis, pupil) - offset, offset,
                                             pupil_.transmission(pupil, kRayWidth)};
                       });
}

}  // namespace petzval::kernel
