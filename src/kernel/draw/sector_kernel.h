// Kernels of lenses whose aberrations are the same in every direction but whose pupil is not: blades, cat's
// eye.
//
// A ray through pupil point (rho, theta) lands at angle theta, at a signed radius that depends on rho alone.
// So along every direction the kernel is the same radial profile, cut where the outline cuts the pupil. One
// sweep from the axis outwards deposits the rings of all wavelengths and keeps what has arrived after each
// zone; every outline, at every place of the picture, reads its directions from there. Directions are finer
// than a pixel at the rim. The cost per kernel does not grow with wavelengths, which makes this many times
// faster than a mesh.
#pragma once

#include "kernel/draw/ring_kernel.h"

#include <algorithm>
#include <vector>

namespace petzval::kernel {

// The light that has arrived along one direction after each zone of the pupil, in all bands.
class RingSweep {
public:
    // reach_px: largest |landing| of all bands.
    RingSweep(const std::vector<RingBand>& bands, double reach_px);
    double reach_px() const { return reach_px_; }

    // Four floats, so that one register holds them; the last means nothing.
    struct alignas(16) Sample {
        float r = 0, g = 0, b = 0, unused = 0;

        friend Sample operator+(Sample p, Sample q) {
            return {p.r + q.r, p.g + q.g, p.b + q.b, p.unused + q.unused};
        }
        friend Sample operator-(Sample p, Sample q) {
            return {p.r - q.r, p.g - q.g, p.b - q.b, p.unused - q.unused};
        }
        friend Sample operator*(float s, Sample p) { return {s * p.r, s * p.g, s * p.b, s * p.unused}; }
    };
    // Light per area integrated over the signed radius from the lowest, after `zones` of zones() (not whole).
    Sample integral(double zones, double radius_px) const {
        const double at = std::clamp((radius_px - low_) * per_step_, 0.0, bins_ - 1e-9);
        const int i = int(at), whole = std::min(int(zones), zones_ - 1);
        const std::size_t row = std::size_t(bins_) + 1;
        const Sample* p = &integrals_[std::size_t(whole) * row + std::size_t(i)];
        const float t = float(at - i), s = float(zones - whole);
        const Sample inner = p[0] + t * (p[1] - p[0]), outer = p[row] + t * (p[row + 1] - p[row]);
        return inner + s * (outer - inner);
    }
    int zones() const { return zones_; }
    double lowest_px() const { return low_; }
    double largest_px() const;

private:
    double low_ = 0, step_ = 0, per_step_ = 0;  // even steps of signed radius, of which 0 is one
    int bins_ = 0, zones_ = 0;
    double reach_px_;
    std::vector<Sample> integrals_;  // zones_ + 1 rows of bins_ + 1
};

// outline: in the f-stop's unit disc, as is_star_about_axis wants it. vertical_scale: pixel aspect,
// multiplies y on the image. Channels sum to 1; colours are not mapped.
PointSpread sector_kernel(const std::vector<Point>& outline, const RingSweep& sweep, double vertical_scale);

// True if every direction from the axis crosses the outline once: what sector_kernel needs.
bool is_star_about_axis(const std::vector<Point>& outline);

}  // namespace petzval::kernel
