// Properties of a lens of rays beyond its kernels: the pupil and the landing of its points. Diffraction needs
// them.
#pragma once

#include "kernel/draw/ring_kernel.h"
#include "kernel/model/coverage.h"
#include "kernel/model/lens_model.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace petzval::kernel {

class GeometricLens : public LensModel {
public:
    // The same lens with another choice, from the rays of this one: the bits of a new model. Null if its rays
    // must be traced anew. Requires: the same camera, and the same shape of the picture.
    virtual std::unique_ptr<const GeometricLens> with(const LensChoice& choice, const Mount& mount) const {
        (void)choice, (void)mount;
        return nullptr;
    }
    // The size of the traced rays, which copies of a lens share.
    virtual std::size_t rays_bytes() const { return 0; }
    // The outline that passes light, seen from `field`; pixel orientation, pupil radii, before pixel aspect.
    virtual std::vector<Point> pupil_outline(FieldPosition field, double tolerance) const = 0;
    // Landing of points of the pupil in pixels, pixel aspect included. Requires: the lens outlives the
    // function.
    virtual std::function<Point(Point)> landing(double wavelength_nm, double coc_radius_px,
                                                FieldPosition field) const = 0;
    // True if every point of the pupil lands at itself x the blur radius, for all wavelengths and places.
    virtual bool is_perfect() const { return false; }
    // False for cylinders: on the axis too, light through a round pupil makes ovals.
    virtual bool is_round() const { return true; }
    // Share of light that passes a point of the pupil, mean over a square.
    virtual double pupil_transmission(Point pupil, double half_width) const = 0;
    // Pixels of the kernel on the axis, from the source's own to the right (ring_row()), if that costs less
    // than the whole kernel. Empty: the whole kernel has to be made.
    virtual std::optional<std::vector<Rgba>> axial_row(double coc_radius_px, RingColours colours) const {
        (void)coc_radius_px, (void)colours;
        return std::nullopt;
    }
};

}  // namespace petzval::kernel
