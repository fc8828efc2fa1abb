#include "files/channels/layer_choice.h"

#include "petzval/names.h"

#include "files/channels/channel_groups.h"
#include "files/wording.h"

#include <algorithm>
#include <set>

namespace petzval {
namespace {

bool holds(const std::vector<std::string>& list, const std::string& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}

// Colours of surfaces, which are not light.
bool is_surface_name(const std::string& name) {
    if (name.find("albedo") != std::string::npos || name.find("occlusion") != std::string::npos) return true;
    return holds({"diffcol", "glosscol", "transcol", "ao", "facing", "fresnel", "mask", "matte", "masks",
                  "mattes", "rgbmatte"},
                 name);
}

// A channel by itself that is part of something else, or no coverage.
bool is_data_channel(const ChannelGroup& group, const std::string& base) {
    static const std::set<std::string> data{"z",  "zback", "u",  "v",  "w",  "x",        "nx",       "ny",
                                            "nz", "px",    "py", "pz", "id", "objectid", "disparity"};
    return data.contains(base) || (base == "y" && group.has("x")) || is_data_name(base);
}

// One layer of colour or one channel, as a candidate.
struct Candidate {
    std::vector<std::string> names;  // what it is called, the first in messages
    std::size_t part = 0;
    std::array<std::string, 4> channels;
    bool is_colour = false, is_light = false;
    std::string data;     // why it is left alone unless named; empty: it is not
    std::string refused;  // why it cannot be blurred; empty: it can
};

// The reason why a channel cannot be blurred.
std::string refusal(const Part& part, const Channel& c) {
    if (part.deep) return "deep";
    if (!part.complete) return "incomplete";
    if (c.type == ChannelType::Uint) return "whole numbers, such as ids";
    if (c.subsampled()) return "subsampled";
    const std::string name = lower(c.layer.empty() ? part.label : c.layer);
    for (const std::string& crypto : part.cryptomattes)
        if (name.starts_with(lower(crypto))) return "Cryptomatte";
    if (name.find("crypto") != std::string::npos) return "Cryptomatte";
    return "";
}

class Candidates {
public:
    Candidates(const Layout& layout, const ColourChoice& colour, const std::optional<DepthChoice>& depth)
        : layout_(layout), colour_(colour) {
        for (const std::string& c : {colour.red, colour.green, colour.blue, colour.alpha, colour.luminance,
                                     colour.chroma_r, colour.chroma_b})
            if (!c.empty()) taken_.insert({colour.part, c});
        if (depth)
            for (const std::string& c : {depth->channel, depth->back})
                if (!c.empty()) taken_.insert({depth->part, c});
        const std::vector<ChannelGroup> groups = groups_of(layout);
        for (const ChannelGroup& group : groups) add(group);
    }
    std::vector<Candidate> all;

private:
    void add(const ChannelGroup& group) {
        const Part& part = layout_.parts[group.part];
        const bool is_own = group.view.empty() || colour_.view.empty() || group.view == colour_.view;
        const auto channel = [&](const char* base) { return group.channel.at(base); };
        std::set<std::string> used;
        if (group.is_rgb() && !taken_.contains({group.part, channel("r")})) {
            Candidate c;
            c.part = group.part, c.is_colour = true;
            c.names = names_of(group, part);
            if (c.names.empty()) c.names.emplace_back(kUnnamed);
            c.channels = {channel("r"), channel("g"), channel("b"), group.has("a") ? channel("a") : ""};
            const std::string name = name_of_layer(group, part);
            c.is_light = !is_surface_name(name) && !is_data_name(name);
            used.insert(c.channels.begin(), c.channels.end());
            finish(c, is_own, is_data_name(name));
        }
        for (const auto& [base, name] : group.channel) {
            if (used.contains(name) || taken_.contains({group.part, name})) continue;
            Candidate c;
            c.part = group.part;
            c.channels[0] = name;
            c.is_light = base == "y" && colour_.is_luminance();
            const std::string layer = group.layer.empty() ? part.name.empty() ? "" : part.label : group.layer;
            const Channel& of_file = *part.find(name);
            c.names = {layer.empty() ? of_file.base : layer + "." + of_file.base, name};
            for (const std::string& of_group : names_of(group, part)) c.names.push_back(of_group);
            finish(c, is_own, is_data_channel(group, base) || is_data_name(name_of_layer(group, part)));
        }
    }

    void finish(Candidate& c, bool is_own, bool is_data) {
        const Part& part = layout_.parts[c.part];
        for (const std::string& name : c.channels)
            if (!name.empty() && c.refused.empty()) c.refused = refusal(part, *part.find(name));
        if (!is_own) c.refused = "of another view";
        if (is_data && c.refused.empty()) c.data = "no light and no coverage, by its name";
        const Rect& ours = layout_.parts[colour_.part].data_window;
        if (c.refused.empty() && part.data_window.intersected(ours) != part.data_window)
            c.refused = "of a data window that reaches beyond the colour's";
        all.push_back(std::move(c));
    }

    const Layout& layout_;
    const ColourChoice& colour_;
    std::set<std::pair<std::size_t, std::string>> taken_;
};

// The request of a list of layers.
struct Wanted {
    bool all = false;
    std::vector<std::string> names, not_these;
    std::vector<std::pair<std::string, LightSpectrum>> lamps;  // of names

    explicit Wanted(const std::vector<std::string>& list) {
        for (const std::string& name : list)
            if (name == "all")
                all = true;
            else if (name.starts_with("-"))
                not_these.push_back(lower(name.substr(1)));
            else
                add(name);
    }
    // "signs:neon" is the layer signs, lit by neon; a colon before any other word is part of a name.
    void add(const std::string& entry) {
        const std::size_t colon = entry.rfind(':');
        const auto lamp = colon == std::string::npos ? Result<LightSpectrum>(Error{})
                                                     : parse<LightSpectrum>(entry.substr(colon + 1));
        names.push_back(lower(lamp ? entry.substr(0, colon) : entry));
        if (lamp) lamps.emplace_back(names.back(), *lamp);
    }
    std::optional<LightSpectrum> lamp_of(const Candidate& c) const {
        for (const auto& [name, lamp] : lamps)
            if (is_one_of(c, {name})) return lamp;
        return {};
    }
    static bool is_one_of(const Candidate& c, const std::vector<std::string>& list) {
        return std::any_of(c.names.begin(), c.names.end(),
                           [&](const std::string& name) { return holds(list, lower(name)); });
    }
};

// Errors: InvalidArgument for a name that no candidate has, or for a layer that cannot be blurred.
Status check_names(const std::string& path, const Wanted& wanted, const std::vector<Candidate>& all) {
    std::vector<std::string> known;
    for (const Candidate& c : all) known.push_back(c.names.front());
    const auto invalid = [&](const std::string& what) {
        return Error{ErrorCode::InvalidArgument, "read.layers " + what, "read.layers"};
    };
    for (const auto* list : {&wanted.names, &wanted.not_these})
        for (const std::string& name : *list) {
            const Candidate* refused = nullptr;
            bool found = false;
            for (const Candidate& c : all) {
                if (!Wanted::is_one_of(c, {name})) continue;
                found = found || c.refused.empty() || list == &wanted.not_these;
                refused = &c;
            }
            if (!found && refused)
                return invalid(printable(name) + " cannot be blurred: it is " + refused->refused);
            if (refused && wanted.lamp_of(*refused) && !(refused->is_colour && refused->is_light))
                return invalid(printable(name) + " names a lamp: only layers of light have one");
            if (!found)
                return invalid(printable(name) + ": " + printable(path, 4096) +
                               " has no such layer or channel" + did_you_mean(name, known) +
                               (known.empty() ? "; it has none beside its colour"
                                              : "; beside its colour it has " + listed(known)));
        }
    return Done{};
}

// Single channels of one part share pictures, three at a time.
void add(const Candidate& c, std::optional<LightSpectrum> lamp, std::vector<LayerChoice>& layers) {
    if (!c.is_colour && !c.is_light)
        for (LayerChoice& layer : layers) {
            auto* const free = std::find(layer.channels.begin(), layer.channels.begin() + 3, "");
            if (layer.is_colour || layer.is_light || layer.part != c.part ||
                free == layer.channels.begin() + 3)
                continue;
            *free = c.channels[0];
            layer.names.push_back(c.names.front());
            return;
        }
    layers.push_back({{c.names.front()}, c.part, c.channels, c.is_colour, c.is_light, lamp});
}

}  // namespace

Result<LayersChoice> choose_layers(const std::string& path, const Layout& layout, const ColourChoice& colour,
                                   const std::optional<DepthChoice>& depth, const ReadOptions& options) {
    const std::vector<Candidate> candidates = Candidates(layout, colour, depth).all;
    const Wanted wanted(options.layers);
    if (Status known = check_names(path, wanted, candidates); !known) return known.error();
    LayersChoice choice;
    for (const Candidate& c : candidates) {
        const bool named = Wanted::is_one_of(c, wanted.names),
                   excluded = Wanted::is_one_of(c, wanted.not_these);
        const std::string why = !c.data.empty() && !named ? c.data
                                : !c.refused.empty()      ? c.refused
                                : excluded                ? "left out by read.layers"
                                : wanted.all || named     ? ""
                                                          : kNotAskedFor;
        if (why.empty())
            add(c, wanted.lamp_of(c), choice.layers);
        else
            choice.carried.push_back({c.names.front(), why});
    }
    return choice;
}

}  // namespace petzval
