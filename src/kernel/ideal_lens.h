// The perfect lens: every point of the pupil lands at radius times its place in the unit disc.
#pragma once

#include "kernel/lens_model.h"
#include "kernel/pupil.h"

namespace petzval::kernel {

class IdealLens final : public LensModel {
public:
    IdealLens(const LensChoice& choice, const Mount& mount)
        : pupil_(choice, mount), pixel_aspect_(mount.pixel_aspect) {}

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override;
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override;
    double reach_px(double coc_radius_px) const override;
    bool varies_over_field() const override { return pupil_.varies_over_field(); }
    Mirrors mirrors() const override { return pupil_.mirrors(); }
    std::string description() const override { return "ideal: no aberration, a flat disc"; }

private:
    void dim(PointSpread& spread, double coc_radius_px) const;

    Pupil pupil_;
    double pixel_aspect_;
};

}  // namespace petzval::kernel
