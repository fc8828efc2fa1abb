// Removes light that no ray can reach, such as a house behind a wall. Hidden layers contain much of it.
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"

namespace petzval::engine {

// Removes samples behind an opaque sheet if no ray through any point of the pupil passes the sheet's end.
// `stretch`: width of the lens's discs, as a multiple of their radius. Engines that composite such samples
// leave a little of the lens free, and the samples would show through it. Sheets end at a closed edge of the
// picture. Beyond an open one they continue, as everything does there.
void drop_out_of_sight(CocSamples& samples, double stretch, const OpenEdges& open, Workers& workers);

}  // namespace petzval::engine
