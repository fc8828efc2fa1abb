// One tile of the picture: every source that reaches it is stamped, layer by layer, and composited by lens
// area.
#pragma once

#include "engine/sources.h"
#include "engine/stamp_table.h"

namespace petzval::engine {

// Writes the pixels of `tile`, which counts rows as the sources do: from row first_row of `out`, the whole
// picture. Where there is a holdout, what a layer adds to a pixel is dimmed by what lies in front of it
// there; the lens area that it takes from farther layers stays.
void spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, CocSamplesView holdout,
                 const Rect& tile, int first_row, View<Rgba> out);

}  // namespace petzval::engine
