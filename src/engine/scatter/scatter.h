// The final-frame engine.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Errors: Cancelled, OutOfMemory.
Result<Output> run_scatter(const EngineView& input, Spare spare = {});

}  // namespace petzval::engine
