// The list of engines.
#pragma once

#include "engine/waist/engine.h"

#include <span>

namespace petzval::engine {

// Every engine there is; the command line, the conformance tests and the benchmarks walk this list.
std::span<const Engine> engines();

}  // namespace petzval::engine
