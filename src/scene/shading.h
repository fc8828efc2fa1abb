// Light as shaders compute it, for scenes that are not baked: of the point alone, from wherever it is seen.
#pragma once

#include "scene/world.h"

namespace petzval::scene {

// A light infinitely far away, and ambient light.
struct Daylight {
    Vec3 towards;                            // it, unit length
    Vec3 sun, ambient_above, ambient_below;  // irradiance
};

// A matt surface, in the sun's shadow or not. Requires: the world outlives it and is not baked.
Vec3 matt(const World& world, const Daylight& light, const SurfacePoint& at, Vec3 albedo);

// Irradiance of a surface from a light without size, or from its shadow black. Requires: as matt().
Vec3 irradiance_from(const World& world, const Light& light, const SurfacePoint& at);

// The lamps of the world in a glossy surface: (n + 8)/(8 pi) (N.H)^n of each, as Blinn has it (1977),
// normalised to keep its light.
Vec3 gloss(const World& world, const SurfacePoint& at, float exponent);

// Reflection of a mirror, by Schlick's approximation (1994): `facing` for a view from the front. Black in
// another mirror.
Vec3 mirrored(const World& world, const SurfacePoint& at, Vec3 facing);

}  // namespace petzval::scene
