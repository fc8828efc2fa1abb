// The engine for previews.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Errors: Cancelled, OutOfMemory.
Result<Output> run_gather(const Input& input);

}  // namespace petzval::engine
