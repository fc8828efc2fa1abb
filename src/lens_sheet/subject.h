// The subject of a page: one lens, its numbers, and functions that trace its rays and discs in micrometres.
//
// The lens stands at its own focal length before a 3:2 frame that its field fills, wide open unless said
// otherwise, focused at infinity where the blur of an axial point is least.
#pragma once

#include "petzval/lens_facts.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include "kernel/lenses/geometric_lens.h"
#include "lens_sheet/svg.h"
#include "optics/prescription.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval::lens_sheet {

using RayLens = std::shared_ptr<const kernel::GeometricLens>;

// A slice of the spectrum on the axis: where light through each height of the pupil lands, which is linear in
// the source's radius, in front of the focus at infinity and beyond it.
struct AxialBand {
    kernel::Light weight;
    // Values at even steps of the height, from the middle to the rim.
    std::vector<double> at_focus_um, per_um_near, per_um_far;

    double height_um(double rho, double coc_um) const;
};
using AxialBands = std::vector<AxialBand>;

// The axis of a lens behind a round aperture: every disc is a set of rings, or of ovals if the lens has
// cylinders, whose heights are those in the vertical plane. Lengths in micrometres.
class Axial {
public:
    explicit Axial(RayLens lens_in_um);

    // Signed height on the sensor of light through pupil radius rho (0…1 of the open part), for a source of
    // that signed CoC radius.
    std::function<double(double rho)> height_um(double wavelength_nm, double coc_um) const;
    // Largest distance from the axis of light of 440 to 660 nm.
    double reach_um(double coc_um) const;
    // Axial rays in that many slices of the spectrum.
    AxialBands bands(int count) const;
    // The disc of all colours, in pixels of um_per_px.
    kernel::PointSpread disc(double coc_um, double um_per_px) const;

private:
    kernel::PointSpread oval(double coc_um, double um_per_px) const;

    RayLens lens_;
    double open_ = 1;  // radius of the stop that the rims leave open
    AxialBands bands_;
};

// Light in each of `rings` rings of even width out to reach_um.
std::vector<kernel::Light> ring_light(const AxialBands& bands, double coc_um, double reach_um, int rings);

class Subject {
public:
    // Errors: those of lens_facts(), and of mounting the lens.
    // Figures are drawn by `workers`, which outlive the subject.
    static Result<Subject> make(const std::string& name_or_file, Workers& workers);

    Workers& workers() const { return *workers_; }
    const std::string& name() const { return facts_.summary.name; }
    const std::string& asked() const { return lens_.name(); }  // name or file, as commands take it
    const LensFacts& facts() const { return facts_; }
    const optics::Prescription* prescription() const;  // null for lenses that are drawn
    double focal_length_mm() const { return focal_length_mm_; }
    double f_number() const { return f_number_; }
    double sensor_width_mm() const { return sensor_width_mm_; }
    double corner_deg() const { return corner_deg_; }  // half field at the frame's corner
    bool has_colour() const;                           // false: one wavelength is all that is known

    // In pixels of about um_per_px, by default exactly one micrometre. Errors: those of the lens (an aperture
    // it does not have, …).
    Result<RayLens> mounted(double f_number, const LensChoice& character = {}, double um_per_px = 1) const;
    // In pixels of about um_per_px, with diffraction, on a lens scaled by `scale`.
    Result<std::shared_ptr<const kernel::LensModel>> wave_lens(double f_number, double um_per_px,
                                                               double scale,
                                                               const LensChoice& character = {}) const;

    const RayLens& open() const { return open_; }
    const Axial& axis() const { return *axis_; }
    // Spread by aberrations of an axial point at best focus, wide open; a small length for a perfect lens.
    // The measure of "near focus" on the page.
    double blur_um() const { return blur_um_; }
    // Position of the sensor from the paraxial focus at 587.56 nm, + away from the lens.
    double best_focus_mm() const { return best_focus_mm_; }
    // Focus of the zones of the pupil from that paraxial focus: (mm, zone 0…1). Empty for the ideal lens.
    std::vector<Point> zone_foci(double wavelength_nm) const;

private:
    explicit Subject(Lens lens) : lens_(std::move(lens)) {}
    kernel::Mount mount(double f_number, double um_per_px, double scale) const;
    void measure();

    Lens lens_;
    Workers* workers_ = nullptr;
    LensFacts facts_;
    double focal_length_mm_ = 50, f_number_ = 2, sensor_width_mm_ = 36, corner_deg_ = 0;
    double blur_um_ = 0, best_focus_mm_ = 0;
    RayLens open_;
    std::optional<Axial> axis_;
};

}  // namespace petzval::lens_sheet
