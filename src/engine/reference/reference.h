// The definition of a correct result: rays, as many as asked for.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Errors: Cancelled, OutOfMemory.
Result<Output> run_reference(const EngineView& input, Spare = {});

}  // namespace petzval::engine
