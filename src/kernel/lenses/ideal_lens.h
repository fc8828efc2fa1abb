// The perfect lens: every point of the pupil lands at radius times its place in the unit disc.
#pragma once

#include "kernel/draw/pupil.h"
#include "kernel/lenses/geometric_lens.h"

namespace petzval::kernel {

class IdealLens final : public GeometricLens {
public:
    IdealLens(const LensChoice& choice, const Mount& mount)
        : pupil_(choice, mount), pixel_aspect_(mount.pixel_aspect) {}

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override;
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override;
    double reach_px(double coc_radius_px) const override;
    bool varies_over_field() const override { return pupil_.varies_over_field(); }
    Mirrors mirrors() const override { return pupil_.mirrors(); }
    std::vector<Point> pupil_outline(FieldPosition field, double tolerance) const override {
        return pupil_.outline(field, tolerance);
    }
    std::function<Point(Point)> landing(double wavelength_nm, double coc_radius_px,
                                        FieldPosition field) const override;
    bool is_perfect() const override { return true; }
    double pupil_transmission(Point pupil, double half_width) const override {
        return pupil_.transmission(pupil, half_width);
    }
    bool is_quick() const override { return true; }
    std::string description() const override { return "ideal: no aberration, a flat disc"; }

private:
    void dim(PointSpread& spread, double coc_radius_px) const;

    Pupil pupil_;
    double pixel_aspect_;
};

}  // namespace petzval::kernel
