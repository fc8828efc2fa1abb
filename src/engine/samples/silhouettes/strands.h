// Separates the pixels of strands: things too thin to show a pixel that touches no silhouette.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/hidden.h"

namespace petzval::engine {

// Separates the pixels that are marked as thin. No pixel shows a strand's own colour alone, so all its pixels
// within about 16 px estimate it together: each covers a part that its shape gives, over a background that
// the pixels beside it give. The part of a single pixel is known less well: the depth of a pixel is that of
// its middle, which a strand may miss. So a pixel whose depth is the strand's shows the farther surface too,
// unless the strand covers most of it.
void unmix_strands(Mixtures& mixtures, const LitPicture& picture, View<const float> coc_px, Workers& workers,
                   const UnmixRule& rule);

}  // namespace petzval::engine
