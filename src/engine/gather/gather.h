// The engine for previews.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Draws given points as well. Errors: Cancelled, OutOfMemory, which says what engine takes more.
Result<Output> run_gather(const Input& input);
Result<Output> run_gather_for(const char* engine, const Input& input);

// The front view alone, in one go, by the pass for real time (docs/design/realtime.md).
Result<Output> run_realtime(const Input& input);

}  // namespace petzval::engine
