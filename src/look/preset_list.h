// One preset out of a list, by its name.
#pragma once

#include "petzval/look_json.h"

#include <string>
#include <vector>

namespace petzval::look {

// Errors: InvalidArgument, with the nearest name and all names, if none of `presets` has that name.
Result<Look> preset_of(const std::vector<LookPreset>& presets, const std::string& name);

}  // namespace petzval::look
