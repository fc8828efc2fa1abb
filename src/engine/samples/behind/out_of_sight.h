// Light that no ray can reach, which hidden layers hold plenty of: the house behind the wall.
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"

namespace petzval::engine {

// Takes out samples behind an opaque one that goes on around it, whatever its radius does there, as far as
// rays through any point of the pupil come past; `stretch`: how much wider than its radius the lens makes a
// disc. Engines would find the same of every sample anew, and not quite: of a lens area taken in parts a
// little stays free, through which what is behind would show. What lies as near to the frame's edge as that
// stays.
void drop_out_of_sight(CocSamples& samples, double stretch, Workers& workers);

}  // namespace petzval::engine
