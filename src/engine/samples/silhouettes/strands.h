// Separates the pixels of strands, objects so thin that all their pixels touch a silhouette, and of the gaps
// between things in front.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/hidden.h"

namespace petzval::engine {

// Separates the pixels that are marked as thin. No pixel shows a strand's own colour alone, so all its pixels
// within about 16 px estimate it together: the shape gives the coverage of each, and the pixels beside it
// give the background. The coverage of a single pixel is less certain, because its depth is that of its
// middle, which a strand may miss. So a pixel with the strand's depth also shows the farther surface, unless
// the strand covers most of the pixel. Pixels that are enclosed by things in front have no clean pixel of the
// surface behind them, which is estimated alike.
void unmix_strands(Mixtures& mixtures, const LitPicture& picture, View<const float> coc_px, Workers& workers,
                   const UnmixRule& rule);

}  // namespace petzval::engine
