// From what a user says of a lens to the lens.
#pragma once

#include "kernel/model/lens_model.h"

#include <memory>
#include <string>
#include <vector>

namespace petzval::kernel {

// True for the ideal lens and lenses drawn as curves, also from files; false for prescriptions and names of
// no lens.
bool is_drawn(const std::string& name);

// Errors: InvalidArgument naming an unknown lens (the message lists the known ones) or an aperture number out
// of range.
Result<std::unique_ptr<const LensModel>> make_lens(const LensChoice& choice, const Mount& mount);

// The lens on the picture's pixels, and on pixels 2, 4, … times as wide, `count` in all. Errors: as above.
Result<std::vector<std::unique_ptr<const LensModel>>> make_lens_levels(const LensChoice& choice,
                                                                       const Mount& mount, int count);

}  // namespace petzval::kernel
