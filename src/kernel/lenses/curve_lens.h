// A lens given by its longitudinal aberration curves.
//
// Light of wavelength w through pupil height h = rho h_rim meets the axis `shift(h, w)` focal lengths away
// from the paraxial focus; the sensor stands s focal lengths from it. Seen on the sensor, a source of signed
// CoC radius c is spread to the signed radius
//     v(rho) = c rho - K rho (shift(rho h_rim, w) - s),     K = h_rim * focal length in pixels
// (similar triangles, to first order in the shift). Marginal light that meets nearer to the lens (shift < 0)
// folds the near disc over into a sharp ring and draws the far disc out into a soft rim.
#pragma once

#include "colour/spectrum.h"
#include "kernel/draw/band_groups.h"
#include "kernel/draw/pupil.h"
#include "kernel/draw/ring_kernel.h"
#include "kernel/draw/sector_kernel.h"
#include "kernel/lenses/aberration_curves.h"
#include "kernel/lenses/field_axis.h"
#include "kernel/lenses/geometric_lens.h"
#include "kernel/lenses/third_order.h"

#include <array>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace petzval::kernel {

class CurveLens final : public GeometricLens {
public:
    // Requires: optics::check(curves), check_aperture(choice), camera numbers > 0.
    CurveLens(const AberrationCurves& curves, const LensChoice& choice, const Mount& mount);

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override;
    PointSpread raw_point_spread(double coc_radius_px, FieldPosition field) const override;
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override;
    double reach_px(double coc_radius_px) const override;
    bool varies_over_field() const override;
    Mirrors mirrors() const override;
    std::vector<Point> pupil_outline(FieldPosition field, double tolerance) const override {
        return pupil_.outline(field, tolerance);
    }
    std::function<Point(Point)> landing(double wavelength_nm, double coc_radius_px,
                                        FieldPosition field) const override;
    double pupil_transmission(Point pupil, double half_width) const override {
        return pupil_.transmission(pupil, half_width);
    }
    bool is_quick() const override { return !varies_over_field() && !pupil_.has_texture(); }
    std::string description() const override { return description_; }

private:
    struct Band {
        colour::SpectralBand spectrum;
        ZoneShift shift;
        double colour = 0;  // colour_place(), of all its wavelengths
    };
    Band band_of(const BandGroup& group) const;
    // The radius that a source has here: the field is curved.
    double here_px(double coc_radius_px, double field) const {
        return coc_radius_px + added_.curvature * field * field;
    }
    void measure_curves();
    const std::vector<Band>& bands_for(int at_least) const;
    Point landing_px(const Band& band, double coc_radius_px, const FieldAxis& axis, Point pupil) const;
    struct Rings {
        std::vector<RingBand> bands;
        double reach_px = 0;
    };
    Rings rings_of(double coc_radius_px, int least_bands) const;
    std::shared_ptr<const RingSweep> sweep_of(double coc_radius_px) const;
    bool is_same_around_the_axis(FieldPosition field) const;  // but for the pupil's outline
    bool has_rings(FieldPosition field) const;                // discs are the same in every direction
    PointSpread ring_spread(double coc_radius_px, RingColours colours) const;
    PointSpread mesh_spread(double coc_radius_px, FieldPosition field) const;

    std::string description_;
    CurveSampler sampler_;
    Pupil pupil_;
    LensChoice choice_;
    double pixel_aspect_;
    double aberration_px_;                   // K
    double focus_;                           // s, focal lengths
    ThirdOrder added_;                       // px; what is on the axis is in the curves
    double largest_shift_ = 0;               // of rho |shift - s| over pupil and wavelengths
    double largest_seen_ = 0;                // the same of wavelengths that count
    double colour_path_ = 0;                 // that rho shift travels over wavelengths that count
    std::vector<std::vector<Band>> ladder_;  // the spectrum cut finer and finer

    mutable std::mutex sweeps_mutex_;
    mutable std::array<std::pair<double, std::shared_ptr<const RingSweep>>, 4> sweeps_;
    mutable std::size_t next_sweep_ = 0;
};

}  // namespace petzval::kernel
