// Channels of a file as users see them: layers of a part, with the meaning of each channel.
#pragma once

#include "files/layout.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace petzval {

// All channels of one layer and view in one part, by their meaning for colour.
struct ChannelGroup {
    std::size_t part = 0;
    std::string layer, view;
    std::map<std::string, std::string> channel;  // "r", "g", "b", "a", "y", "ry", "by", "z" -> name

    bool has(const char* base) const { return channel.contains(base); }
    bool is_rgb() const { return has("r") && has("g") && has("b"); }
    bool is_colour(bool deep) const {
        if (is_rgb() || (has("y") && !has("x"))) return true;
        return deep && has("a") && has("z");  // an opacity-only deep image
    }
};

// Those of readable parts, in the file's order.
std::vector<ChannelGroup> groups_of(const Layout& layout);

// Names a user may type for a group: the layer, the part, or both.
std::vector<std::string> names_of(const ChannelGroup& group, const Part& part);
bool is_called(const ChannelGroup& group, const Part& part, const std::string& wanted);
inline constexpr const char* kUnnamed = "(unnamed)";
// Display name of each group: its first unique name, otherwise its first name, otherwise kUnnamed.
std::vector<std::string> names_to_type(const std::vector<ChannelGroup>& groups, const Layout& layout);

// The last component of its layer, or the label of its part; lower case.
std::string name_of_layer(const ChannelGroup& group, const Part& part);
// True if a layer of that name holds neither light nor coverage, even with R, G, B: depth, normals,
// positions, motion, texture coordinates, ids.
bool is_data_name(const std::string& name);

}  // namespace petzval
