// Choice of the channels that are blurred with the colour or copied, with reasons. No pixels, no OpenEXR.
#pragma once

#include "petzval/result.h"

#include "files/channels/channel_choice.h"
#include "files/layout.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

// A picture beside the colour.
struct LayerChoice {
    std::vector<std::string> names;  // what people call it: one of a colour, else one for each channel
    std::size_t part = 0;
    // File channels for red, green, blue and alpha; empty: none. For a colour all of them, otherwise up to
    // three unrelated channels that share a picture.
    std::array<std::string, 4> channels;
    bool is_colour = false;
    bool is_light = false;  // as far as names tell
    std::optional<LightSpectrum> spectrum = {};
};

struct LayersChoice {
    std::vector<LayerChoice> layers;
    std::vector<CarriedLayer> carried;  // those that stay as they are
};

// options.layers: "all", or names of layers, parts and channels; "-NAME" after "all" leaves one out, and
// "NAME:LAMP" names the lamp of a colour's light. Of the
// view of `colour` alone; never the colour or its depth. Left alone unless named: depth, normals, positions,
// motion, texture coordinates. Left alone by "all" and refused by name: identifiers (whole numbers,
// Cryptomatte by its metadata or name), subsampled channels, parts that reach beyond the colour's data
// window. Errors: InvalidArgument for a name that the file does not have or that is refused.
Result<LayersChoice> choose_layers(const std::string& path, const Layout& layout, const ColourChoice& colour,
                                   const std::optional<DepthChoice>& depth, const ReadOptions& options);

}  // namespace petzval
