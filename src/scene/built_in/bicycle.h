// The subject of the night scene: a town bicycle with a basket of flowers.
#pragma once

#include "scene/world.h"

namespace petzval::scene {

// Position of the bicycle: the point of the ground under its rear hub, and the horizontal unit vector towards
// its front.
struct Stand {
    Vec3 rear, forward;
    // A point given by metres ahead of the rear hub, above the ground, and to the left-hand side.
    Vec3 at(float ahead, float above, float aside = 0) const {
        return rear + ahead * forward + Vec3{-aside * forward.z, above, aside * forward.x};
    }
};

// Adds tubes, saddle, basket and flowers, and its two small lamps.
void add_bicycle(World& world, const Stand& stand);

}  // namespace petzval::scene
