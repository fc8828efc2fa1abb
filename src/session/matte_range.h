// Mattes stay mattes: what was within 0…1 before a blur, which is a mean, is so after it.
#pragma once

#include "petzval/defocus.h"
#include "petzval/rendered.h"

#include "base/parallel.h"

namespace petzval {

// Limits each channel of the report's layers that are not light to 0…1 where all of it was within before.
// Engines leave the range by the last digits of their kernels' sums, and `gather` and `gaussian` by more
// where they draw bright parts of a layer on their own.
void keep_matte_range(DefocusReport& report, const Rendered& rendered, Workers& workers);

}  // namespace petzval
