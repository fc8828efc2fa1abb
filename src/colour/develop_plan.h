// A part of a picture to be developed, by the CPU or by another device.
#pragma once

#include "petzval/develop.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace petzval::colour {

struct DevelopPlan {
    DevelopSettings settings;  // its workers are not asked
    Rect part;                 // of the picture
    int x0 = 0, y0 = 0;        // the pixel of the dither's pattern that its first one is

    std::size_t channels() const { return settings.alpha ? 4 : 3; }
    std::size_t pixels() const { return std::size_t(part.width()) * std::size_t(part.height()); }
    float exposure() const;
    int largest_code() const { return (1 << settings.bits) - 1; }
};

// The exponent of the code that is light; 0: sRGB's curve, which is none.
double power_of(Transfer transfer);

// Does the work of petzval::develop().
std::vector<std::uint16_t> develop(View<const Rgba> picture, const DevelopPlan& plan, Workers& workers);

}  // namespace petzval::colour
