#include "lens_sheet/subject.h"

#include "kernel/draw/mesh_kernel.h"
#include "kernel/draw/ring_kernel.h"
#include "kernel/lenses/make_lens.h"
#include "kernel/lenses/opened_lens.h"
#include "kernel/model/gamut.h"
#include "lens_sheet/light.h"
#include "optics/aberrations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace petzval::lens_sheet {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kPrimary_nm = 587.5618;
constexpr double kLeastField_deg = 1;
constexpr int kZones = 40, kHeights = 256, kSlices = 93;

std::vector<kernel::RingBand> ring_bands(const AxialBands& bands, double coc_um, double um_per_px) {
    std::vector<kernel::RingBand> rings;
    for (const AxialBand& band : bands)
        rings.push_back({band.weight, kernel::at_each([&band, coc_um, um_per_px](double area) {
                             return band.height_um(std::sqrt(area), coc_um) / um_per_px;
                         })});
    return rings;
}

double reach_of(const std::vector<kernel::RingBand>& bands) {
    double reach = 0;
    std::array<double, kZones + 1> areas, landed;
    for (std::size_t i = 0; i < areas.size(); ++i) areas[i] = double(i) / kZones;
    for (const kernel::RingBand& band : bands) {
        band.landings_px(areas, landed.data());
        for (const double radius : landed) reach = std::max(reach, std::abs(radius));
    }
    return 1.02 * reach + 1e-6;
}

}  // namespace

Axial::Axial(RayLens lens_in_um) : lens_(std::move(lens_in_um)) {
    open_ = 0;
    for (const Point& p : lens_->pupil_outline({}, 1e-3)) open_ = std::max(open_, std::hypot(p.x, p.y));
    open_ = std::min(open_, 1.0);
    bands_ = bands(kSlices);
}

double AxialBand::height_um(double rho, double coc_um) const {
    const double at = rho * double(at_focus_um.size() - 1);
    const std::size_t i = std::min(std::size_t(at), at_focus_um.size() - 2);
    const double t = at - double(i);
    const std::vector<double>& per_um = coc_um < 0 ? per_um_near : per_um_far;
    return (1 - t) * (at_focus_um[i] + coc_um * per_um[i]) +
           t * (at_focus_um[i + 1] + coc_um * per_um[i + 1]);
}

AxialBands Axial::bands(int count) const {
    AxialBands bands;
    for (const colour::SpectralBand& slice : slices(count)) {
        AxialBand& band = bands.emplace_back();
        band.weight = {slice.r, slice.g, slice.b};
        const auto sharp = height_um(slice.wavelength_nm, 0);
        const auto near = height_um(slice.wavelength_nm, -1), far = height_um(slice.wavelength_nm, 1);
        for (int i = 0; i <= kHeights; ++i) {
            const double rho = double(i) / kHeights;
            band.at_focus_um.push_back(sharp(rho));
            band.per_um_near.push_back(band.at_focus_um.back() - near(rho));
            band.per_um_far.push_back(far(rho) - band.at_focus_um.back());
        }
    }
    return bands;
}

std::function<double(double)> Axial::height_um(double wavelength_nm, double coc_um) const {
    return [landing = lens_->landing(wavelength_nm, coc_um, {}), open = open_,
            round = lens_->is_round()](double rho) {
        return round ? landing({rho * open, 0}).x : landing({0, rho * open}).y;
    };
}

double Axial::reach_um(double coc_um) const {
    double reach = 0;
    for (int nm = 440; nm <= 660; nm += 20) {
        const auto height = height_um(nm, coc_um);
        for (int i = 0; i <= kZones; ++i)
            reach = std::max(reach, std::abs(height(std::sqrt(double(i) / kZones))));
        if (lens_->is_round()) continue;
        const auto landing = lens_->landing(nm, coc_um, {});
        for (int i = 0; i <= kZones; ++i)
            reach = std::max(reach, std::abs(landing({open_ * std::sqrt(double(i) / kZones), 0}).x));
    }
    return reach;
}

kernel::PointSpread Axial::oval(double coc_um, double um_per_px) const {
    constexpr int kOvalSlices = 31;
    const double size_px = reach_um(coc_um) / um_per_px;
    kernel::MeshPupil pupil;
    pupil.outline = kernel::subdivided(lens_->pupil_outline({}, kernel::mesh_tolerance(size_px)),
                                       kernel::mesh_step(size_px));
    pupil.rings = kernel::mesh_rings(size_px);
    std::vector<kernel::MeshBand> bands;
    for (const colour::SpectralBand& slice : slices(kOvalSlices))
        bands.push_back({{slice.r, slice.g, slice.b},
                         [landing = lens_->landing(slice.wavelength_nm, coc_um, {}), um_per_px](
                             std::span<const Point> points, Point* landed) {
                             for (const Point& p : points) *landed++ = (1 / um_per_px) * landing(p);
                         }});
    kernel::PointSpread disc = kernel::mesh_kernel(pupil, bands);
    kernel::map_into_gamut(disc);
    return disc;
}

kernel::PointSpread Axial::disc(double coc_um, double um_per_px) const {
    if (!lens_->is_round()) return oval(coc_um, um_per_px);
    const auto rings = ring_bands(bands_, coc_um, um_per_px);
    return kernel::ring_kernel(rings, reach_of(rings), kernel::RingColours::InGamut);
}

std::vector<kernel::Light> ring_light(const AxialBands& bands, double coc_um, double reach_um, int rings) {
    const auto ring_band = ring_bands(bands, coc_um, reach_um / rings);
    const double reach = std::max(double(rings), std::ceil(reach_of(ring_band)));
    std::vector<kernel::Light> light = kernel::ring_energy(ring_band, reach, std::size_t(reach));
    light.resize(std::size_t(rings));
    return light;
}

const optics::Prescription* Subject::prescription() const { return kernel::prescription_of(lens_); }

bool Subject::has_colour() const { return !prescription() || prescription()->dispersion_known; }

kernel::Mount Subject::mount(double f_number, double um_per_px, double scale) const {
    kernel::Mount mount;
    mount.camera.focal_length_mm = focal_length_mm_ * scale;
    mount.camera.sensor_width_mm = sensor_width_mm_ * scale;
    mount.camera.f_number = f_number;
    mount.camera.focus_distance_m = std::numeric_limits<double>::infinity();
    mount.display_width_px = std::max(2, int(std::lround(1000 * sensor_width_mm_ * scale / um_per_px)));
    mount.display_height_px = std::max(1, mount.display_width_px * 2 / 3);
    return mount;
}

Result<RayLens> Subject::mounted(double f_number, const LensChoice& character, double um_per_px) const {
    const auto opened = lens_.with(character);
    if (!opened) return opened.error();
    auto lens = kernel::make_lens(*opened, mount(f_number, um_per_px, 1));
    if (!lens) return lens.error();
    const std::shared_ptr<const kernel::LensModel> model = std::move(*lens);
    return std::dynamic_pointer_cast<const kernel::GeometricLens>(model);
}

Result<std::shared_ptr<const kernel::LensModel>> Subject::wave_lens(double f_number, double um_per_px,
                                                                    double scale,
                                                                    const LensChoice& character) const {
    LensChoice choice = character;
    choice.wave = true;
    if (choice.wavelengths == 0) choice.wavelengths = 15;
    const auto opened = lens_.with(choice);
    if (!opened) return opened.error();
    auto lens = kernel::make_lens(*opened, mount(f_number, um_per_px, scale));
    if (!lens) return lens.error();
    return std::shared_ptr<const kernel::LensModel>(std::move(*lens));
}

std::vector<Point> Subject::zone_foci(double wavelength_nm) const {
    std::vector<Point> points;
    if (const optics::Prescription* lens = prescription()) {
        const auto first = optics::first_order(*lens, lens->primary_um);
        std::vector<double> zones;
        for (int i = 0; i <= kZones; ++i) zones.push_back(double(i) / kZones);
        const double um[] = {wavelength_nm / 1000, kPrimary_nm / 1000};
        const auto lsa = optics::longitudinal_aberration(*lens, *first, um, zones);
        // Measured from the paraxial focus at d, for any primary wavelength of the lens.
        for (std::size_t i = 0; i < zones.size(); ++i)
            points.push_back({lsa.shift_mm[0][i] - lsa.shift_mm[1][0], zones[i]});
    } else if (facts_.summary.model == LensModelKind::Curves) {
        // Computed by similar triangles from the sensor positions of rays, like the kernels.
        const auto height = axis_->height_um(wavelength_nm, 0);
        for (int i = 0; i <= kZones; ++i) {
            const double zone = std::max(double(i), 0.1) / kZones;
            points.push_back(
                {best_focus_mm_ - height(zone) / zone * 2 * f_number_ / 1000, double(i) / kZones});
        }
    }
    return points;
}

void Subject::measure() {
    const double least_um = focal_length_mm_;  // 1/1000 of the focal length
    blur_um_ = std::max(axis_->reach_um(0), 0.02 * least_um);
    if (facts_.summary.model == LensModelKind::Ideal) blur_um_ = 0.4 * least_um;
    constexpr double kNearAxis = 0.02;
    best_focus_mm_ = axis_->height_um(kPrimary_nm, 0)(kNearAxis) / kNearAxis * 2 * f_number_ / 1000;
}

Result<Subject> Subject::make(const std::string& name_or_file, Workers& workers) {
    LensChoice choice;
    choice.name = name_or_file;
    const auto lens = Lens::open(choice);
    if (!lens) return lens.error();
    Subject subject(*lens);
    subject.workers_ = &workers;
    auto facts = lens_facts(*lens);
    if (!facts) return facts.error();
    subject.facts_ = std::move(*facts);
    const LensFacts& f = subject.facts_;
    if (f.efl_mm > 0) subject.focal_length_mm_ = f.efl_mm;
    // Rounded up, so that the lens has it.
    if (f.f_number > 0) subject.f_number_ = f.f_number * (1 + 1e-9);
    const double format = f.sensor_width_mm > 0 ? f.sensor_width_mm / subject.focal_length_mm_ : 0.72;
    double corner = 0.5 * std::hypot(1.0, 2.0 / 3) * format;
    if (f.has_prescription && f.field_deg < kLeastField_deg) corner = std::tan(kLeastField_deg * kDegree);
    subject.corner_deg_ = std::atan(corner) / kDegree;
    const double width_mm = 2 * corner * subject.focal_length_mm_ / std::hypot(1.0, 2.0 / 3);
    subject.sensor_width_mm_ = std::ceil(1000 * width_mm) / 1000;
    auto open = subject.mounted(subject.f_number_);
    if (!open) return open.error();
    subject.open_ = std::move(*open);
    subject.axis_.emplace(subject.open_);
    subject.measure();
    return subject;
}

}  // namespace petzval::lens_sheet
