// A park in the sun, 5 to 40 m away: what stands behind people and grass.
#pragma once

#include "scene/world.h"

namespace petzval::scene {

// Path, lawn, trees, a kiosk with a striped awning, bunting, a house; and the sky. The ground lies at y = 0.
void add_park(World& world);

}  // namespace petzval::scene
