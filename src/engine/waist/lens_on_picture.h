// A lens mounted on a camera, and where the pixels of a picture lie in its field.
#pragma once

#include "petzval/image.h"
#include "petzval/light_spectrum.h"
#include "petzval/place.h"

#include "kernel/model/lens_model.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace petzval::engine {

// A lens as the light of a lamp sees it: its levels.
struct LampLens {
    LightSpectrum light = LightSpectrum::Daylight;
    std::vector<std::unique_ptr<const kernel::LensModel>> levels;
};

struct LensOnPicture : PixelField {
    // The lens on pixels 1, 2, 4, … times as wide. At least one; the last stands for all beyond.
    std::span<const std::unique_ptr<const kernel::LensModel>> levels;
    std::span<const LampLens> lamps;  // for points of light whose spectrum is none of the picture's
    Rect frame;  // the display window, in pixels of the picture: zones of the lens are parts of it
    double tan_per_field = 0;         // of the angle from the axis, per half diagonal; 0: not known
    double focus_distance_m = 0;      // 0: unknown
    float radius_at_infinity_px = 0;  // 0: unknown

    const kernel::LensModel& level(int n) const {
        return *levels[std::min(std::size_t(n), levels.size() - 1)];
    }
    // On a picture that begins at pixel (x, y) of this one.
    LensOnPicture from(int x, int y) const {
        LensOnPicture lens = *this;
        lens.field_centre_x -= x, lens.field_centre_y -= y;
        lens.frame = frame.moved(-x, -y);
        return lens;
    }
};

}  // namespace petzval::engine
