#include "petzval/names.h"

#include "files/channels/channel_choice.h"
#include "files/wording.h"

#include <algorithm>
#include <tuple>

namespace petzval {
namespace {

struct Candidate {
    std::size_t part = 0;
    const Channel* channel = nullptr;
    std::string layer;  // lower case, last component; the part's label where the channel has no layer
    std::string base;   // lower case
};

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

// Names of depth channels, best first. A pattern sees the channel as a Candidate, and if it lies in the layer
// of the colour. To support a new name, add a row.
struct Pattern {
    const char* why;
    bool (*matches)(const Candidate& c, bool layer_of_colour);
};
constexpr const char* kLookedFor =
    "Z, depth.Z, ….Depth.Z, VRayZDepth, depth.R, …WorldDepth.R";  // for messages
constexpr Pattern kPatterns[] = {
    {"Z of the colour's own layer", [](const Candidate& c, bool own) { return own && c.base == "z"; }},
    {"plain Z", [](const Candidate& c, bool) { return c.channel->layer.empty() && c.base == "z"; }},
    {"Z of a depth layer", [](const Candidate& c, bool) { return c.layer == "depth" && c.base == "z"; }},
    {"a VRayZDepth layer",
     [](const Candidate& c, bool) { return c.layer.find("zdepth") != std::string::npos; }},
    {"a depth layer",
     [](const Candidate& c, bool) {
         return is_one_of(c.layer, {"depth", "z"}) && is_one_of(c.base, {"r", "y", "v", "x", "red", "depth"});
     }},
    {"named like depth",
     [](const Candidate& c, bool) {
         return c.channel->layer.empty() && is_one_of(c.base, {"depth", "zdepth", "z-depth"});
     }},
    {"a layer named like depth",  // Unreal's FinalImageMovieRenderQueue_WorldDepth, Octane's Z-depth
     [](const Candidate& c, bool) {
         const bool is_unreal = c.layer.find("worlddepth") != std::string::npos;
         return (is_unreal || is_one_of(c.layer, {"z-depth", "zdepth"})) &&
                is_one_of(c.base, {"r", "y", "v", "x", "red", "z"});
     }},
    {"Z of another layer", [](const Candidate& c, bool) { return c.base == "z"; }},
};

std::string last_component(const std::string& layer) {
    const std::size_t dot = layer.rfind('.');
    return lower(dot == std::string::npos ? layer : layer.substr(dot + 1));
}

// The Z of a vector (normal, position, motion) is not depth: it comes with an X, or its layer says so.
bool is_vector_component(const Part& part, const Channel& channel) {
    for (const Channel& c : part.channels)
        if (c.layer == channel.layer && c.view == channel.view && lower(c.base) == "x") return true;
    return is_one_of(last_component(channel.layer.empty() ? part.label : channel.layer),
                     {"n", "normal", "normals", "p", "pworld", "position", "motion", "vector"});
}

std::vector<Candidate> candidates_of(const Layout& layout) {
    std::vector<Candidate> all;
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        const Part& part = layout.parts[p];
        if (!part.readable) continue;
        for (const Channel& c : part.channels) {
            const std::string layer = last_component(c.layer.empty() ? part.label : c.layer);
            // Mist is not a distance: 0…1, by a curve.
            if (c.subsampled() || is_vector_component(part, c) || layer == "mist") continue;
            all.push_back({p, &c, layer, lower(c.base)});
        }
    }
    return all;
}

std::vector<std::string> channel_names(const Layout& layout) {
    std::vector<std::string> names;
    for (const Part& part : layout.parts)
        for (const Channel& c : part.channels)
            names.push_back(layout.parts.size() > 1 && !part.name.empty() ? part.name + "." + c.name
                                                                          : c.name);
    return names;
}

DepthChoice choice_of(const Layout& layout, std::size_t p, const Channel& channel, const std::string& why) {
    const Part& part = layout.parts[p];
    DepthChoice choice;
    choice.part = p;
    choice.channel = channel.name;
    if (part.deep)
        for (const Channel& c : part.channels)
            if (c.layer == channel.layer && c.view == channel.view && lower(c.base) == "zback")
                choice.back = c.name;
    choice.line = "depth: " + printable(channel.name) + (choice.back.empty() ? "" : " and " + choice.back);
    if (!part.title.empty()) choice.line += " of " + part.title;
    choice.line += ": " + why;
    return choice;
}

// 0 same view, 1 no view, 2 another view.
int view_distance(const std::string& view, const std::string& wanted) {
    return view == wanted ? 0 : view.empty() || wanted.empty() ? 1 : 2;
}

Result<DepthChoice> named_channel(const std::string& path, const Layout& layout, const ColourChoice* colour,
                                  const std::string& wanted) {
    const Channel* best = nullptr;
    std::size_t best_part = 0;
    auto best_order = std::tuple(9, 9, false, std::size_t(0));
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        const Part& part = layout.parts[p];
        for (const Channel& c : part.channels) {
            const std::string plain = c.layer.empty() ? c.base : c.layer + "." + c.base;
            int quality = 9;
            for (const std::string& name :
                 {c.name, part.name + "." + c.name, part.label + "." + c.name, plain}) {
                if (name == wanted) quality = 0;
                if (quality > 1 && lower(name) == lower(wanted)) quality = 1;
            }
            const bool deep_elsewhere = part.deep && !(colour && p == colour->part);
            if (quality == 9 || !part.readable || c.subsampled() || deep_elsewhere) continue;
            const int distance = colour ? view_distance(c.view, colour->view) : 0;
            const auto order = std::tuple(quality, distance, colour && p != colour->part, p);
            if (!best || order < best_order) best = &c, best_part = p, best_order = order;
        }
    }
    if (!best)
        return Error{ErrorCode::InvalidArgument, printable(path, 4096) + ": has no channel '" +
                                                     printable(wanted) + "'" +
                                                     did_you_mean(wanted, channel_names(layout)) +
                                                     "; it has " + listed(channel_names(layout))};
    return choice_of(layout, best_part, *best, "asked for with read.depth_channel");
}

std::optional<DepthChoice> by_pattern(const Layout& layout, const ColourChoice* colour) {
    const std::vector<Candidate> all = candidates_of(layout);
    for (const Pattern& pattern : kPatterns) {
        const Candidate* best = nullptr;
        auto best_order = std::tuple(9, false, false);
        for (const Candidate& c : all) {
            const Part& part = layout.parts[c.part];
            const bool own = colour && c.part == colour->part && c.channel->layer == colour->layer;
            if (!pattern.matches(c, own)) continue;
            const int distance = colour ? view_distance(c.channel->view, colour->view) : 0;
            if (distance == 2) continue;
            // Two layers of the same name: take the one beside the colour ("ViewLayer.Depth" and
            // ".Combined").
            const auto group = [](const std::string& layer) { return layer.substr(0, layer.find('.')); };
            const bool apart = colour && group(c.channel->layer) != group(colour->layer);
            const auto order = std::tuple(distance, colour && c.part != colour->part, apart);
            if (part.deep && !(colour && c.part == colour->part)) continue;
            if (!best || order < best_order) best = &c, best_order = order;
        }
        if (best) return choice_of(layout, best->part, *best->channel, pattern.why);
    }
    return std::nullopt;
}

// World positions, from which the camera matrix makes planar depth.
std::optional<DepthChoice> by_position(const Layout& layout, const ColourChoice* colour) {
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        const Part& part = layout.parts[p];
        if (part.deep || !part.readable) continue;
        for (const Channel& c : part.channels) {
            const std::string layer = last_component(c.layer.empty() ? part.label : c.layer);
            if (!is_one_of(layer, {"p", "pworld", "worldposition"}) || c.subsampled()) continue;
            if (!is_one_of(lower(c.base), {"x", "r", "red"})) continue;
            if (colour && view_distance(c.view, colour->view) == 2) continue;
            DepthChoice choice;
            choice.part = p;
            const std::string prefix = c.name.substr(0, c.name.size() - c.base.size());
            for (const auto& names : {std::array<std::string, 3>{"X", "Y", "Z"},
                                      {"x", "y", "z"},
                                      {"R", "G", "B"},
                                      {"r", "g", "b"},
                                      {"red", "green", "blue"}}) {
                const bool all = std::all_of(names.begin(), names.end(),
                                             [&](const std::string& n) { return part.find(prefix + n); });
                if (all) choice.position = {prefix + names[0], prefix + names[1], prefix + names[2]};
            }
            if (!choice.is_position()) continue;
            choice.line = "depth: from world position " + printable(choice.position[0]) +
                          " … and worldToCamera" + ": the file has no depth channel";
            return choice;
        }
    }
    return std::nullopt;
}

// A file that holds nothing but depth: its only channel, or red of a grey picture.
std::optional<DepthChoice> of_depth_file(const Layout& layout) {
    const Channel *only = nullptr, *red = nullptr;
    std::size_t count = 0, only_part = 0, red_part = 0;
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        if (layout.parts[p].deep || !layout.parts[p].readable) continue;
        for (const Channel& c : layout.parts[p].channels) {
            if (c.subsampled()) continue;
            ++count, only = &c, only_part = p;
            if (!red && is_one_of(lower(c.base), {"r", "y", "red"})) red = &c, red_part = p;
        }
    }
    if (count == 1) return choice_of(layout, only_part, *only, "the only channel of the depth file");
    if (!red) return std::nullopt;
    DepthChoice choice = choice_of(layout, red_part, *red,
                                   "the depth file has no depth channel (looked for " +
                                       std::string(kLookedFor) + "), its first colour channel was taken");
    choice.is_colour = true;
    return choice;
}

}  // namespace

Result<DepthChoice> choose_depth(const std::string& path, const Layout& layout, const ColourChoice* colour,
                                 const ReadOptions& options, bool has_camera_matrix) {
    if (!options.depth_channel.empty()) return named_channel(path, layout, colour, options.depth_channel);
    if (auto found = by_pattern(layout, colour)) return *found;
    if (has_camera_matrix)
        if (auto found = by_position(layout, colour)) return *found;
    if (!colour)
        if (auto found = of_depth_file(layout)) return *found;
    for (const Part& part : layout.parts)
        for (const Channel& c : part.channels)
            if (last_component(c.layer.empty() ? part.label : c.layer) == "mist")
                return invalid_file(
                    path, "has no depth channel but mist, which is not a distance; read.depth_channel " +
                              printable(c.name) + " depth.kind mist depth.range START,END reads it as depth");
    return invalid_file(
        path, "has no depth channel (looked for " + std::string(kLookedFor) +
                  ", P); name one with read.depth_channel or a file with read.depth_file; its channels are " +
                  listed(channel_names(layout)));
}

}  // namespace petzval
