// Chosen lights as sprites, over another engine's picture.
#pragma once

#include "engine/waist/engine.h"

namespace petzval::engine {

// Errors: Cancelled, OutOfMemory.
Result<Output> run_sprites(const EngineView& input, Spare = {});

}  // namespace petzval::engine
