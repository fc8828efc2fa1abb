// Finds neighbouring pixels of one surface, from their signed circles of confusion.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/completion_model.h"

#include <cmath>

namespace petzval::engine {

// True if a step of the radius continues the slope beside it: the two steps `next` to it and `beyond` that
// belong to one surface themselves. (With one step, a sliver one pixel wide would connect what lies before
// and behind it.)
inline bool continues_slope(float step_px, float next_px, float beyond_px) {
    const auto alike = [](float a, float b) {
        return std::abs(a - b) <= completion_model.slope_tolerance * std::abs(a);
    };
    return alike(step_px, next_px) &&
           (std::abs(next_px) <= completion_model.between_px() || alike(next_px, beyond_px));
}

// Bits of a pixel: connected to its neighbour on that side. Beyond the picture counts as connected.
enum Connected : unsigned char { kLeft = 1, kRight = 2, kUp = 4, kDown = 8, kAll = 15 };

// Connections of every pixel of a plane of signed radii.
Image<unsigned char> connections(View<const float> coc_px, Workers& workers);

// Change of the radius per pixel along x and y within the surface of each pixel: the mean of the steps to its
// connected neighbours.
struct Slope {
    float x = 0, y = 0;
};
Slope slope_at(View<const float> coc_px, View<const unsigned char> connected, int x, int y);

}  // namespace petzval::engine
