// One tile of the picture: every source that reaches it is stamped, layer by layer, and composited by lens
// area.
#pragma once

#include "engine/sources.h"
#include "engine/stamp_table.h"

namespace petzval::engine {

// Writes the pixels of `tile`, which counts rows as the sources do: from row first_row of `out`, the whole
// picture.
void spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, const Rect& tile,
                 int first_row, View<Rgba> out);

}  // namespace petzval::engine
