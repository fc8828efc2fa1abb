// Light that no ray can reach, which hidden layers hold plenty of: the house behind the wall.
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"

namespace petzval::engine {

// Removes samples behind an opaque sheet if no ray through any point of the pupil passes the sheet's end.
// `stretch`: width of the lens's discs, as a multiple of their radius. Without this, engines would composite
// these samples one by one and leave a little of the lens free, through which they would show. Samples that
// rays could reach past the frame's border stay.
void drop_out_of_sight(CocSamples& samples, double stretch, Workers& workers);

}  // namespace petzval::engine
