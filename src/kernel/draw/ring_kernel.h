// Kernels of lenses that are the same in every direction: exact ring energy instead of sample points.
//
// The light of a thin zone of the pupil lands in a thin ring; it is deposited as an annulus with its exact
// energy, so a caustic is bright but never grainy, at any size. Rings of all wavelengths make one radial
// profile, and the profile is integrated over the squares of the pixels.
#pragma once

#include "kernel/model/coverage.h"
#include "kernel/model/spread.h"

#include <functional>
#include <span>
#include <vector>

namespace petzval::kernel {

// A wavelength band: its share of the channels, and the signed radii in pixels at which the light of pupil
// radii sqrt(area) lands, areas in 0…1: as many as there are areas. A negative radius lies on the other side
// of the axis.
struct RingBand {
    Light weight;
    std::function<void(std::span<const double> areas, double* landed)> landings_px;
    std::function<double(double area)> light = {};  // per area of the pupil; empty: 1 everywhere
};

// Landings of a given function.
template <typename Landing>  // double(double area)
auto at_each(Landing landing) {
    return [landing](std::span<const double> areas, double* landed) {
        for (const double area : areas) *landed++ = landing(area);
    };
}

// The light that falls into each of `bins` rings of even width between the axis and reach_px, the largest
// |landing| of all bands: exact energies, nothing sampled. Requires: reach_px > 0, bins >= 1.
std::vector<Light> ring_energy(const std::vector<RingBand>& bands, double reach_px, std::size_t bins);

// Channels sum to 1. reach_px: largest |landing| of all bands.
enum class RingColours {
    Raw,
    InGamut,  // see gamut.h
};
PointSpread ring_kernel(const std::vector<RingBand>& bands, double reach_px,
                        RingColours colours = RingColours::Raw);
// The row of pixels of the same kernel from the source's own pixel to the right.
std::vector<Rgba> ring_row(const std::vector<RingBand>& bands, double reach_px,
                           RingColours colours = RingColours::Raw);

}  // namespace petzval::kernel
