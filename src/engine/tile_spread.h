// One tile of the picture: every source that reaches it is stamped, layer by layer, and composited by lens
// area.
#pragma once

#include "engine/sources.h"
#include "engine/stamp_table.h"

namespace petzval::engine {

// Writes the pixels of `tile` (picture coordinates). `row_offset`: row 0 of the picture in the frame the
// stamp table divides into parts.
void spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, const Rect& tile,
                 View<Rgba> out);

}  // namespace petzval::engine
