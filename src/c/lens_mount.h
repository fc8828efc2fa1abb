// The camera on which a C host mounts a lens.
#pragma once

#include "petzval/lens_kernel.h"
#include "petzval/petzval_c.h"
#include "petzval/result.h"

namespace petzval::c {

// Null, and numbers that are 0, stand for the numbers of the lens's own camera. Errors: InvalidArgument
// naming the field; those of own_camera().
Result<LensMount> mount_of(const petzval_lens_mount* given, const Lens& lens);

}  // namespace petzval::c
