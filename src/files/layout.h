// Contents of a file as plain values: parts, layers, views, channels. Enough to choose the channels to read.
#pragma once

#include "petzval/files.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

enum class ChannelType { Uint, Half, Float };
inline constexpr float kLargestHalf = 65504.f;

// Channel `forward.left.u` has layer "forward", view "left" and base "u".
struct Channel {
    std::string name, layer, view, base;
    ChannelType type = ChannelType::Half;
    int x_sampling = 1, y_sampling = 1;

    friend bool operator==(const Channel&, const Channel&) = default;
    bool subsampled() const { return x_sampling != 1 || y_sampling != 1; }
};

struct Part {
    std::string name;   // "" where the file gives none
    std::string label;  // the name without its view: "depth_left" -> "depth"
    std::string view, type, compression;
    Rect data_window;
    bool deep = false, tiled = false;
    bool readable = true;  // false: of a type this OpenEXR does not know
    bool complete = true;  // false: chunks are missing, it was cut off or is still being written
    std::vector<Channel> channels;
    std::vector<std::string> cryptomattes;  // names of such layers, by the part's metadata

    const Channel* find(const std::string& channel_name) const;
    // "part 3 'depth_right'"; "" in a file of one part.
    std::string title;
};

// Eight numbers: x and y of red, green, blue and white.
using Chromaticities = std::array<double, 8>;

struct Layout {
    Rect display_window;
    double pixel_aspect = 1;
    std::vector<Part> parts;
    std::vector<std::string> views;  // in the file's order; the first is its default
};

// True if both layouts have the same pixels in the same places.
bool same_pixels(const Layout& a, const Layout& b);

// Splits a channel name. `views` are those the part declares for its channels (attribute multiView), default
// first. OpenEXR's rule: the last component but one may be the view, and a name without any dot belongs to
// the default view.
Channel split_channel_name(const std::string& name, const std::vector<std::string>& views);
// "depth_left", "left" -> "depth"; also with '.', '-', ' ' and with the view in front.
std::string without_view(const std::string& part_name, const std::string& view);

}  // namespace petzval
