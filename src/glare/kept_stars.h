// Stars between frames: making one takes longer than laying it over a picture.
#pragma once

#include "petzval/glare.h"
#include "petzval/workers.h"

#include "base/kept.h"
#include "device/device.h"
#include "glare/filter.h"

#include <cstddef>
#include <memory>

namespace petzval::glare {

// All that decides a star, and the transforms that it is kept as.
struct StarShape {
    ApertureShape aperture;
    double radius_px = 1;
    double reddest_px = 0;
    double pixel_aspect = 1;
    int transform_size = 0;
    bool operator==(const StarShape&) const = default;
};

// Star kernels kept between frames. Any number of threads may use it at once.
class KeptStars {
public:
    // The star for pictures of this size: that of a frame before, or a new one. radius_px and diffraction_px:
    // star_kernel().
    std::shared_ptr<const Filter> star(const ApertureShape& aperture, double radius_px, double diffraction_px,
                                       double pixel_aspect, int width, int height, Workers& workers);
    std::size_t bytes() const { return stars_.bytes(); }
    void trim(std::size_t max_bytes) { stars_.trim(max_bytes); }

private:
    Kept<StarShape, Filter> stars_;
};

// petzval::add_glare() with the stars of earlier frames, on this device, which can do it
// (session/open_device.h). Throws the device's errors. passed: receives the times of ghosts, of a star's
// pattern, and of the device.
Status add_glare(device::Canvas& picture, const GlareSettings& settings, KeptStars& stars,
                 const device::Device& device, const device::Passed& passed);

}  // namespace petzval::glare
