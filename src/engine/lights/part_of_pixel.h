// The place of a lamp's light in its pixel.
#pragma once

#include "kernel/model/lens_model.h"

namespace petzval::engine {

// A pixel on the rim of a lamp shows the lamp in a part of it, which lies against the rest of the lamp. As if
// it lay in the middle, discs of lamps near focus would be a pixel too wide.
struct PartOfPixel {
    // A part along an axis is a point in the middle, the whole width, or a number of eighths of a pixel by
    // which its middle lies right of or below the pixel's. Then it is 1 - |eighths| / 4 wide.
    static constexpr int kPoint = 0, kMostEighths = 3, kWhole = 4;
    int x = kPoint, y = kPoint;
    friend bool operator==(const PartOfPixel&, const PartOfPixel&) = default;
};

// The part of a lamp's pixel along an axis, by the luminance of the pixel and of those before and after it,
// each without that of their surroundings.
int part_along(float before, float own, float after);

// The kernel of light in a part of its pixel: rays, each landing on a rectangle of the part's size.
// Requires: a lens that does not blur what is in focus, and a radius of a few pixels.
kernel::PointSpread spread_of_part(const kernel::LensModel& lens, double coc_radius_px,
                                   kernel::FieldPosition field, PartOfPixel part);

}  // namespace petzval::engine
