// Lamps as scenes of HexaDrive's demo have them.
#pragma once

#include "scene/world.h"

#include <array>
#include <cstddef>

namespace petzval::scene {

inline Vec3 lamp_colour(int i) {
    constexpr std::array<Vec3, 6> kColours{{{1, 0.62f, 0.28f},
                                            {1, 0.86f, 0.62f},
                                            {0.55f, 0.76f, 1},
                                            {1, 0.20f, 0.16f},
                                            {0.30f, 1, 0.52f},
                                            {1, 0.42f, 0.75f}}};
    return kColours[std::size_t(i) % kColours.size()];
}

// Adds a lamp whose disc shows about `glow`, through an aperture `blur_tangent` times the focus distance in
// radius, focused on `focus_m`. The camera stands at the origin.
inline void add_disc(World& world, Vec3 at, float radius_m, Vec3 colour, float glow, float blur_tangent,
                     float focus_m) {
    // Tangents of the lamp's own radius and of its circle of confusion.
    const float own = radius_m / at.z, blur = blur_tangent * std::abs(1 / focus_m - 1 / at.z);
    world.add_lamp(at, radius_m, glow * std::max(1.0f, blur * blur / (own * own)) * colour);
}

}  // namespace petzval::scene
