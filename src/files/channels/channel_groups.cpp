#include "files/channels/channel_groups.h"

#include "files/wording.h"

#include <algorithm>

namespace petzval {
namespace {

// Long and short spellings, any case.
std::string meaning(const std::string& base) {
    const std::string b = lower(base);
    if (b == "red") return "r";
    if (b == "green") return "g";
    if (b == "blue") return "b";
    if (b == "alpha") return "a";
    return b;
}

std::string last_component(const std::string& layer) {
    const std::size_t dot = layer.rfind('.');
    return lower(dot == std::string::npos ? layer : layer.substr(dot + 1));
}

bool holds(const std::vector<std::string>& list, const std::string& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

}  // namespace

bool is_data_name(const std::string& name) {
    // Parts of longer names: Nworld_normal, MotionVector, worldPosition.
    for (const char* part :
         {"crypto", "depth", "normal", "position", "motion", "velocity", "disparity", "vector"})
        if (name.find(part) != std::string::npos) return true;
    static const std::vector<std::string> whole{
        "z",          "n",      "ng",       "ns",        "p",          "pworld",      "pref",    "nref",
        "uv",         "uvs",    "uvw",      "st",        "texcoord",   "mv",          "forward", "backward",
        "id",         "ids",    "objectid", "object_id", "materialid", "material_id", "nodeid",  "renderid",
        "instanceid", "primid", "indexob",  "indexma",   "mist",       "samplecount"};
    return holds(whole, name);
}

std::vector<ChannelGroup> groups_of(const Layout& layout) {
    std::vector<ChannelGroup> groups;
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        if (!layout.parts[p].readable) continue;
        const std::size_t first = groups.size();
        for (const Channel& c : layout.parts[p].channels) {
            auto group =
                std::find_if(groups.begin() + std::ptrdiff_t(first), groups.end(),
                             [&](const ChannelGroup& g) { return g.layer == c.layer && g.view == c.view; });
            if (group == groups.end())
                group = groups.insert(groups.end(), ChannelGroup{p, c.layer, c.view, {}});
            group->channel.emplace(meaning(c.base), c.name);
        }
    }
    return groups;
}

std::vector<std::string> names_of(const ChannelGroup& g, const Part& part) {
    std::vector<std::string> names;
    const std::string full = g.layer.empty() ? g.view : g.view.empty() ? g.layer : g.layer + "." + g.view;
    if (!g.layer.empty()) names.push_back(g.layer);
    if (!part.name.empty() && part.name != g.layer) names.push_back(part.name);
    if (part.label != part.name) names.push_back(part.label);
    if (full != g.layer && full != part.view) names.push_back(full);
    if (!part.name.empty() && !g.layer.empty()) names.push_back(part.name + "." + g.layer);
    return names;
}

bool is_called(const ChannelGroup& g, const Part& part, const std::string& wanted) {
    for (const std::string& name : names_of(g, part))
        if (lower(name) == lower(wanted)) return true;
    return false;
}

std::vector<std::string> names_to_type(const std::vector<ChannelGroup>& groups, const Layout& layout) {
    std::vector<std::vector<std::string>> all;
    all.reserve(groups.size());
    for (const ChannelGroup& g : groups) all.push_back(names_of(g, layout.parts[g.part]));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto is_own = [&](const std::string& name) {
            for (std::size_t k = 0; k < all.size(); ++k)
                if (k != i && holds(all[k], name)) return false;
            return true;
        };
        const auto own = std::find_if(all[i].begin(), all[i].end(), is_own);
        names.push_back(own != all[i].end() ? *own : all[i].empty() ? kUnnamed : all[i].front());
    }
    return names;
}

std::string name_of_layer(const ChannelGroup& g, const Part& part) {
    return last_component(g.layer.empty() ? part.label : g.layer);
}

}  // namespace petzval
