// Depth that was stored in few codes, as in a file of 8 bits: between plateaus of neighbouring codes it
// steps, where the surface that was stored does not.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

namespace petzval {

// The step from one code to the next. 0: values have no codes, or too few to know them from things at a few
// depths. Values that are not finite, or of a size of 1e10 or more, are none. `are_codes`: they were read
// from whole numbers.
float quantum_of(View<const float> values, bool are_codes);

// Joins plateaus one quantum apart: each value moves by at most half a quantum, along the line from the
// middle of the step on one side of its plateau to that on the other. Steps of more are edges and stay;
// `has_value` is false where a value means that there is none.
Plane without_steps(View<const float> values, float quantum, bool (*has_value)(float));

}  // namespace petzval
