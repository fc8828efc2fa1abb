// The pupil as it is seen from one place of the picture: the outline that passes light, and points spread
// evenly over it.
#pragma once

#include "petzval/lens.h"
#include "petzval/result.h"

#include "kernel/lens_model.h"
#include "kernel/outline.h"

#include <cstdint>
#include <vector>

namespace petzval::kernel {

// Aperture and barrel of one lens on one camera. Coordinates as in outline.h, before pixel aspect.
class Pupil {
public:
    explicit Pupil(const LensChoice& choice);

    // tolerance: largest distance of a chord from its arc, in pupil radii.
    std::vector<Point> outline(FieldPosition field, double tolerance) const;
    bool varies_over_field() const { return cats_eye_ > 0; }
    Mirrors mirrors() const;
    // A full, round, open disc as seen from `field`.
    bool is_disc(FieldPosition field) const;

private:
    ApertureShape shape_;
    double cats_eye_;
};

// Errors: InvalidArgument naming the number that is out of range and what would be accepted.
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
