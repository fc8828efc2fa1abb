// The light of turns, gathered on one level's grid and combined by lens area.
#pragma once

#include "device/cpu/atlas.h"
#include "device/cpu/gather_planes.h"
#include "engine/gather/plan.h"

namespace petzval::device::gathering {

// Turns begin…end-1 of a plan: as many in a row as are combined on one level's grid.
struct TurnGroup {
    int begin = 0, end = 0, level = 0;
};
std::vector<TurnGroup> turn_groups(const engine::RingSizes& sizes);

// Combines the light of a group in `into`, which holds the cells `target` of the group's level: of level 0
// with the light of groups before it, else the group's alone. Returns where any light landed, counted from
// the first cell of the target; if that is empty, `into` is unchanged.
Rect combine_turns(const engine::GatherPlan& plan, const TapAtlas& atlas, const TurnGroup& group,
                   const Rect& target, Workspace& workspace, Combined& into);

}  // namespace petzval::device::gathering
