// The pupil as it is seen from one place of the picture: the outline that passes light, and points spread
// evenly over it.
#pragma once

#include "petzval/lens_choice.h"
#include "petzval/result.h"

#include "kernel/draw/outline.h"
#include "kernel/draw/transmission.h"
#include "kernel/model/lens_model.h"

#include <cstdint>
#include <vector>

namespace petzval::kernel {

// Aperture, barrel, and the dust and textures in the pupil, of one lens on one camera. Coordinates as in
// outline.h, before pixel aspect.
class Pupil {
public:
    // Requires: check_aperture(choice).
    Pupil(const LensChoice& choice, const Mount& mount);

    // tolerance: largest distance of a chord from its arc, in pupil radii.
    std::vector<Point> outline(FieldPosition field, double tolerance) const;
    bool varies_over_field() const { return cats_eye_ > 0 || !rims_.empty(); }
    Mirrors mirrors() const;
    // A full, round, open disc as seen from `field`.
    bool is_disc(FieldPosition field) const;

    bool has_texture() const { return texture_ != nullptr; }
    // Share of the light that passes around a point, over a square; 1 without texture.
    double transmission(Point middle, double half_width) const {
        return texture_ ? texture_->mean_inside(middle, half_width, half_width) : 1;
    }

private:
    ApertureShape shape_;
    double cats_eye_;
    BarnDoors doors_;
    struct Rim {
        double radius, shift;  // pupil radii; shift per unit of field, away from it
    };
    std::vector<Rim> rims_;
    std::shared_ptr<const PupilImage> texture_;
};

// Tangent of the angle at which the camera's pinhole sees the corner of the picture (field size 1).
double corner_tangent(const Mount& mount);

// Errors: InvalidArgument naming the number that is out of range and its accepted range.
Status check_aperture(const LensChoice& choice);

// `count` points of equal share of the outline's area: a Hammersley set (i/n, radical inverse of i) shifted
// by the seed, carried over by the map that keeps areas. The third coordinate, for wavelengths, is in 0…1.
// Source: Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, 1992 (the point set).
struct PupilPoint {
    Point place;
    double third = 0;
};
std::vector<PupilPoint> spread_evenly(const std::vector<Point>& outline, int count, std::uint64_t seed);

}  // namespace petzval::kernel
