// The gather method step by step as it was published: docs/explain/published.md says where from, and where we
// set units right.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// The picture that input.options.of<GatherOwn>().gather.stage asks for. Requires: a stage other than Final.
Result<Output> run_gather_stage(const EngineView& input);

}  // namespace petzval::engine
