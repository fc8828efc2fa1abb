// The engine for previews.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Draws given points as well. Errors: Cancelled, OutOfMemory, which says what engine takes more.
Result<Output> run_gather(const EngineView& input, Spare = {});
Result<Output> run_gather_for(const char* engine, const EngineView& input);

// The front view alone, in one go, by the pass for real time (docs/explain/real-time.md).
Result<Output> run_realtime(const EngineView& input, Spare = {});

}  // namespace petzval::engine
