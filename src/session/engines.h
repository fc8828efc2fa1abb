// The list of engines.
#pragma once

#include "engine/waist/engine.h"
#include "session/request.h"

#include <span>

namespace petzval::engine {

// Every engine there is; the command line, the conformance tests and the benchmarks walk this list.
std::span<const Engine> engines();

}  // namespace petzval::engine

namespace petzval {

// The engine that the look names. Errors: InvalidArgument with the valid names; also if it does not take a
// given holdout or layers, or would mix layers with surfaces estimated from the picture alone.
Result<const engine::Engine*> find_engine(const FrameRequest& request);

}  // namespace petzval
