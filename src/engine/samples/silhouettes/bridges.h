// Finds where a strand continues between the pixels whose depth shows it.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/hidden.h"

namespace petzval::engine {

// The depth of a pixel is that of its middle. A strand thinner than a pixel misses the middle of many pixels
// in a row, although their colour shows it. Returns the radii with the strand's own radius in these gaps, or
// an empty plane if there are no gaps. A gap is followed along the colour for up to 16 px. It counts only if
// it leads to another pixel of the same strand, or fades as a tip does; a line of a texture ends elsewhere.
Plane bridged_strands(const LitPicture& picture, View<const float> coc_px,
                      View<const unsigned char> connected, Workers& workers);

}  // namespace petzval::engine
