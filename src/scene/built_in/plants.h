// Leaves and twigs, shared by the scenes that need something to stand close to the lens.
#pragma once

#include "scene/world.h"

#include <cstdint>

namespace petzval::scene {

// A leaf from its stalk to `tip`, bent and a little folded along its middle; u runs across, v along.
Mesh leaf(Vec3 stalk, Vec3 tip, Vec3 facing, float half_width, int pieces = 8);

// A crown or a bush: a closed body with dents and bulges `rough` of its size.
Mesh bush(Vec3 centre, Vec3 radii, float rough);

struct Foliage {
    Vec3 stem, leaf_at_stalk, leaf_at_tip;  // albedos
    float leaf_length_m = 0.04f;
};

// One bent branch with alternate leaves on short stalks.
void add_twig(World& world, Vec3 from, Vec3 to, int leaves, const Foliage& foliage, std::uint32_t seed);

}  // namespace petzval::scene
