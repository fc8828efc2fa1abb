// Gaussian depth of field.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// The least job.max_memory_bytes that it runs in.
std::size_t least_gaussian_bytes(const EngineView& input);

// Errors: Cancelled, OutOfMemory.
Result<Output> run_gaussian(const EngineView& input, Spare = {});

}  // namespace petzval::engine
