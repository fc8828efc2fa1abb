// The engine for previews.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Draws given points as well. Errors: Cancelled; OutOfMemory, whose message names the engine.
Result<Output> run_gather(const EngineView& input, Spare = {});
Result<Output> run_gather_for(const char* engine, const EngineView& input);

// Draws the visible surfaces only, in one piece, by the real-time pass (docs/explain/real-time.md).
Result<Output> run_realtime(const EngineView& input, Spare = {});

}  // namespace petzval::engine
