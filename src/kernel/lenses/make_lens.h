// A lens on a camera, for pictures of one size.
#pragma once

#include "petzval/lens.h"

#include "kernel/model/lens_model.h"

#include <memory>
#include <vector>

namespace petzval::kernel {

// Errors: InvalidArgument naming a camera number that the lens needs, an aperture it does not have, or a
// focus too near for it.
Result<std::unique_ptr<const LensModel>> make_lens(const Lens& lens, const Mount& mount);
// The model of a lens that is used once. Errors: also those of Lens::open().
Result<std::unique_ptr<const LensModel>> make_lens(const LensChoice& choice, const Mount& mount);

// The lens as make_lens() makes it, remembered for the next call: costs next to nothing while the camera
// stays, for pictures of other sizes as well if the model has on_pixels(). Errors: those of make_lens().
Result<std::shared_ptr<const LensModel>> model_on(const Lens& lens, const Mount& mount);

// The lens on the picture's pixels, and on pixels 2, 4, … times as wide, `count` in all. Errors: as above.
Result<std::vector<std::unique_ptr<const LensModel>>> make_lens_levels(const Lens& lens, const Mount& mount,
                                                                       int count);

}  // namespace petzval::kernel
