// Gaussian depth of field.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Errors: Cancelled, OutOfMemory.
Result<Output> run_gaussian(const Input& input);

}  // namespace petzval::engine
