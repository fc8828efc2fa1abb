// The surfaces of a flat picture as final frames draw them. Previews have their own (flat_surfaces.h).
#pragma once

#include "engine/samples/flat_surfaces.h"
#include "engine/samples/kept_surfaces.h"
#include "engine/samples/lamps/lamps.h"

#include <memory>

namespace petzval::engine {

// The surfaces of the input's picture, with its plate.
FlatSurfaces found_surfaces(const EngineView& input, View<const unsigned char> connected, const Dim& dim);
// The lamps behind them that no pixel shows.
HiddenLamps found_lamps(const EngineView& input, const FlatSurfaces& surfaces, const Dim& dim);

// Both, with those of a plate that covers the frame; kept for later frames of the picture.
std::shared_ptr<const FoundSurfaces> surfaces_and_lamps(const EngineView& input,
                                                        View<const unsigned char> connected, const Dim& dim);

}  // namespace petzval::engine
