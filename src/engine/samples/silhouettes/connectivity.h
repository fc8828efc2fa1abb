// Finds neighbouring pixels of one surface, from their signed circles of confusion.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/completion_model.h"

#include <cmath>

namespace petzval::engine {

// A narrow step always connects, because it hides almost nothing.
inline bool always_connected(float coc_a_px, float coc_b_px) {
    return std::abs(coc_b_px - coc_a_px) <= completion_model.step_between_px(coc_a_px, coc_b_px);
}

// True if two neighbouring samples belong to one surface. A larger step connects them only if it continues
// the slope on one of its sides. A slope is the signed change of radius, from the sample before a to a, or
// from b to the sample after b.
inline bool same_surface(float coc_a_px, float coc_b_px, float slope_before_a_px, float slope_after_b_px) {
    if (always_connected(coc_a_px, coc_b_px)) return true;
    const float step = coc_b_px - coc_a_px;
    const float tolerance = completion_model.slope_tolerance * std::abs(step);
    return std::abs(step - slope_before_a_px) <= tolerance || std::abs(step - slope_after_b_px) <= tolerance;
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
