// Changes of light by a lens besides blur.
#pragma once

#include "petzval/glare.h"
#include "petzval/image.h"
#include "petzval/place.h"
#include "petzval/result.h"

#include "device/device.h"
#include "glare/kept_stars.h"
#include "session/request.h"

namespace petzval {

bool has_glare(const GlareAmounts& glare);

struct Light {
    const FrameRequest& request;  // its lens is open
    Place place;                  // where the picture's pixels lie
    glare::KeptStars& stars;
    const device::Device& device;

    // Light lost towards the corners, on the CPU. Errors: those of add_falloff().
    Status add_falloff_to(Picture& picture) const;
    // Errors: those of add_glare().
    Status add_glare_to(device::Canvas& picture, const device::Passed& passed = {}) const;
};

}  // namespace petzval
