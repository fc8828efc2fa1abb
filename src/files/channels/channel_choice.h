// Choice of the colour and depth channels of a file, with reasons. No pixels, no OpenEXR.
#pragma once

#include "petzval/result.h"

#include "files/layout.h"

#include <string>

namespace petzval {

struct ColourChoice {
    std::size_t part = 0;
    std::string layer, view;                    // layer as split_channel_name() has it
    std::string red, green, blue, alpha;        // channel names; alpha may be empty
    std::string luminance, chroma_r, chroma_b;  // instead of red, green, blue: Y, and RY, BY where they exist
    std::string line;                           // for Frame::detected

    bool is_luminance() const { return !luminance.empty(); }
};

struct DepthChoice {
    std::size_t part = 0;
    std::string channel;
    std::string back;                     // ZBack of a deep part
    std::array<std::string, 3> position;  // instead of channel: x, y, z of a world position
    std::string line;
    bool is_colour = false;  // as DepthOfFile::is_colour

    bool is_position() const { return !position[2].empty(); }
};

// Errors: InvalidFile without any colour; InvalidArgument for a layer or view the file does not have, listing
// those it has.
Result<ColourChoice> choose_colour(const std::string& path, const Layout& layout, const ReadOptions& options);

// Depth that belongs to `colour`, or for a file that holds depth alone (colour == nullptr).
// `has_camera_matrix` permits a world position as the last resort. Errors: InvalidFile without any depth;
// InvalidArgument for a channel the file does not have.
Result<DepthChoice> choose_depth(const std::string& path, const Layout& layout, const ColourChoice* colour,
                                 const ReadOptions& options, bool has_camera_matrix);

}  // namespace petzval
