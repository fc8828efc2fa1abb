// What each level of detail of the scatter engine drew, side by side in one oversized picture.
//
// After HexaDrive's demo of 2009 (docs/published/hexadrive.md), which let its vertex shader shift every
// sprite to the part of one large buffer that belongs to its level. The accumulations are shown before they
// are composited: light of all depths added up, alpha the lens area it takes up (above 1 where several
// surfaces send light).
#pragma once

#include "engine/scatter/sources.h"
#include "engine/waist/engine.h"

namespace petzval::engine {

// Level 0 at the top left, highlights right of it; below, the reduced levels side by side, and a map of which
// level drew what at half size. Output::panels says where each lies. Errors: Cancelled, OutOfMemory.
Result<Output> run_scatter_levels(const Input& input, const LevelRule& rule);

}  // namespace petzval::engine
