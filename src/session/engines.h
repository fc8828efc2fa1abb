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

// The engine that the look names. Errors: InvalidArgument, with the names that would do; where it takes no
// holdout or layers that are given, or would mix these with what the picture alone knows.
Result<const engine::Engine*> find_engine(const FrameRequest& request);

}  // namespace petzval
