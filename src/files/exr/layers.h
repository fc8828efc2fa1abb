// Pictures beside the colour, read to be blurred with it.
#pragma once

#include "petzval/files.h"
#include "petzval/result.h"

#include "files/channels/layer_choice.h"
#include "files/exr/file.h"

#include <vector>

namespace petzval {

// Records in the frame the layers blurred with the colour and the copied ones.
void describe_layers(const LayersChoice& choice, Frame& frame);

// Fills frame.layers, in the data window of frame.colour, which is read already (in the file's primaries). An
// alpha of a layer's own that is not the colour's becomes a channel by itself, in `layers` too. What exceeds
// the colour's light by far is taken for no light. Values that are not finite are replaced and counted.
Status read_layers(const ExrFile& exr, std::vector<LayerChoice>& layers, Frame& frame);

}  // namespace petzval
