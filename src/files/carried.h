// Data of a file beside the colour that petzval works on. Pixels are not kept in memory: the file stays open,
// and write_exr() copies from it.
#pragma once

#include "files/channels/channel_choice.h"
#include "files/channels/layer_choice.h"
#include "files/input_file.h"
#include "files/layout.h"
#include "files/primaries.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

class CarriedContent {
public:
    std::shared_ptr<const InputFile> file;
    Layout layout;
    ColourChoice colour;
    std::vector<LayerChoice> layers;  // those of Frame::layers
    std::string depth_channel;        // of the colour's part, empty if it has none
    std::optional<PrimariesConversion> primaries;
    std::size_t max_pixels = 0;
};

}  // namespace petzval
