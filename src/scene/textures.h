// Procedural patterns whose detail ends where the author says, so that a box-filtered pixel holds little
// noise.
#pragma once

#include "scene/vec3.h"

#include <cstdint>

namespace petzval::scene {

float smoothstep(float from, float to, float x);
// 0…1, one value per lattice cell.
float cell_value(int i, int j, std::uint32_t seed);
// Smooth noise around 0, about -1…1, wavelengths of about one unit.
float noise(Vec3 p);
// `octaves` of noise, each half as strong and twice as fine.
float fractal_noise(Vec3 p, int octaves);
// 1 on stripes of `duty` of a period of 1, 0 between, with edges `softness` wide.
float stripes(float x, float duty, float softness);
// 0…1 checks of side 1 with soft edges.
float checks(float x, float y, float softness);

struct Brick {
    float mortar;  // 0 on a brick, 1 on mortar
    int column, row;
};
// Bricks of 1 x 1 in running bond.
Brick brick(float x, float y, float joint_x, float joint_y);

}  // namespace petzval::scene
