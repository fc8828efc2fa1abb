// A disc photographed or drawn, used as it is: one picture for each side of focus.
#pragma once

#include "kernel/draw/pupil.h"
#include "kernel/model/lens_model.h"

namespace petzval::kernel {

// Errors: InvalidArgument when a picture holds no light in one of its channels, or the far one is missing.
Status check_kernel_images(const KernelImages& images);

class ImageLens final : public LensModel {
public:
    // Requires: check_kernel_images(choice.kernel_images).
    ImageLens(const LensChoice& choice, const Mount& mount);

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override;
    // Rays of the far picture on both sides: they are linear in the radius, so they cannot change the
    // picture.
    std::vector<PupilRay> rays(int count, FieldPosition field, std::uint64_t seed) const override;
    double reach_px(double coc_radius_px) const override;
    bool varies_over_field() const override { return pupil_.varies_over_field(); }
    bool is_quick() const override { return true; }
    std::string description() const override { return "a disc as in the kernel image"; }

private:
    struct Channels {
        PupilImage r, g, b;

        explicit Channels(View<const Rgba> picture);
        Rgba mean(Point middle, double half_width, double half_height) const;
    };
    Pupil pupil_;
    double pixel_aspect_;
    bool near_given_;
    Channels far_, near_;
};

}  // namespace petzval::kernel
