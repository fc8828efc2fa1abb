// A bricked box in focus, a floor that comes towards it, and a branch near the camera across the box's edge.
//
// What stands behind the branch does not depend on the aperture, so this picture can be held to its exact
// answer at any: the branch blurred by the disc of its depth over the rest, which is in focus (the floor is
// dark and even, and is not scored). 640 x 480, an ideal lens of 85 mm, sensor 36 mm, focus 3 m.
#pragma once

#include "completion_shots.h"

namespace petzval::bench {

// tilt_deg: of the branch against the upright. Compared at 5 times the exposure.
CompletionShot branch_shot(double tilt_deg, double f_number);

}  // namespace petzval::bench
