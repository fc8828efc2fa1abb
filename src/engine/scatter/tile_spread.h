// One tile of the picture: every source that reaches it is stamped, layer by layer, and composited by lens
// area.
#pragma once

#include "engine/scatter/sources.h"
#include "engine/scatter/stamp_table.h"
#include "engine/waist/work.h"

namespace petzval::engine {

// Writes the pixels of `tile`, which counts rows as the sources do: from row first_row of `out`, the whole
// picture. Where there is a holdout, what a layer adds to a pixel is dimmed by what lies in front of it
// there; the lens area that it takes from farther layers stays.
// One budget for the whole lens does not know which part of it each of three surfaces takes: where at least
// rule.surfaces_for_cells reach a tile, parts of the pupil are composited each on its own. Returns what it
// took.
Work spread_tile(const std::vector<SourceLevel>& levels, const StampTable& table, CocSamplesView holdout,
                 const Rect& tile, int first_row, const LevelRule& rule, View<Rgba> out);

}  // namespace petzval::engine
