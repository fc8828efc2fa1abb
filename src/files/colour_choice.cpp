#include "petzval/names.h"

#include "files/channel_choice.h"
#include "files/wording.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace petzval {
namespace {

// All channels of one layer and view in one part, by what they mean for colour.
struct Group {
    std::size_t part = 0;
    std::string layer, view;
    std::map<std::string, std::string> channel;  // "r", "g", "b", "a", "y", "ry", "by", "z" -> name

    bool has(const char* base) const { return channel.contains(base); }
    bool is_colour(bool deep) const {
        if (has("r") && has("g") && has("b")) return true;
        if (has("y") && !has("x")) return true;
        return deep && has("a") && has("z");  // an opacity-only deep image
    }
};

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

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

// The finished picture, as renderers and compositors name it.
bool is_beauty_name(const std::string& name) {
    return is_one_of(name, {"combined", "beauty", "rgba", "rgb", "image", "color", "colour", "c", "main",
                            "final", "composite", "rgb_color", "bty"});
}

// Layers that have R, G, B channels but are not light.
bool is_data_name(const std::string& name) {
    if (name.find("crypto") != std::string::npos || name.find("zdepth") != std::string::npos) return true;
    return is_one_of(
        name, {"depth", "z", "normal", "normals", "n", "p", "pworld", "pref", "position", "uv", "st",
               "motion", "motionvector", "vector", "velocity", "id", "objectid", "indexob", "indexma"});
}

std::vector<Group> groups_of(const Layout& layout) {
    std::vector<Group> groups;
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        if (!layout.parts[p].readable) continue;
        const std::size_t first = groups.size();
        for (const Channel& c : layout.parts[p].channels) {
            auto group = std::find_if(groups.begin() + std::ptrdiff_t(first), groups.end(),
                                      [&](const Group& g) { return g.layer == c.layer && g.view == c.view; });
            if (group == groups.end()) group = groups.insert(groups.end(), Group{p, c.layer, c.view, {}});
            group->channel.emplace(meaning(c.base), c.name);
        }
    }
    return groups;
}

// What a user may call a group: the layer, the part, or both.
std::vector<std::string> names_of(const Group& g, const Part& part) {
    std::vector<std::string> names;
    const std::string full = g.layer.empty() ? g.view : g.view.empty() ? g.layer : g.layer + "." + g.view;
    if (!g.layer.empty()) names.push_back(g.layer);
    if (!part.name.empty() && part.name != g.layer) names.push_back(part.name);
    if (part.label != part.name) names.push_back(part.label);
    if (full != g.layer && full != part.view) names.push_back(full);
    if (!part.name.empty() && !g.layer.empty()) names.push_back(part.name + "." + g.layer);
    return names;
}

bool is_called(const Group& g, const Part& part, const std::string& wanted) {
    for (const std::string& name : names_of(g, part))
        if (lower(name) == lower(wanted)) return true;
    return false;
}

constexpr int kData = 4;
// Smaller is a better guess.
int rank(const Group& g, const Part& part) {
    const std::string name = last_component(g.layer.empty() ? part.label : g.layer);
    if (is_data_name(name)) return kData;
    if (g.layer.empty() && (name.empty() || is_beauty_name(name))) return 0;
    if (is_beauty_name(name)) return 1;
    return g.layer.empty() ? 2 : 3;
}

Result<std::vector<Group>> of_wanted_view(const std::string& path, const Layout& layout,
                                          const std::string& view, std::vector<Group> groups) {
    if (view.empty()) return groups;
    std::vector<Group> kept;
    for (const Group& g : groups)
        if (lower(g.view) == lower(view)) kept.push_back(g);
    if (kept.empty())
        return Error{ErrorCode::InvalidArgument, printable(path, 4096) + ": has no view '" + printable(view) +
                                                     "' with colour; views: " + listed(layout.views)};
    return kept;
}

Result<std::vector<Group>> of_wanted_layer(const std::string& path, const Layout& layout,
                                           const std::string& layer, std::vector<Group> groups) {
    if (layer.empty()) return groups;
    std::vector<Group> kept;
    std::vector<std::string> names;
    for (const Group& g : groups) {
        const Part& part = layout.parts[g.part];
        if (is_called(g, part, layer)) kept.push_back(g);
        const auto known = names_of(g, part);
        names.push_back(known.empty() ? "(unnamed)" : known.front());
    }
    if (kept.empty())
        return Error{ErrorCode::InvalidArgument, printable(path, 4096) + ": has no colour layer or part '" +
                                                     printable(layer) + "'" + did_you_mean(layer, names) +
                                                     "; it has " + listed(names)};
    return kept;
}

std::string reason(const Group& g, const Part& part, const ReadOptions& options, std::size_t candidates) {
    if (!options.layer.empty()) return "asked for with read.layer";
    if (candidates == 1) return "the only colour there is";
    switch (rank(g, part)) {
        case 0:
            return "the plain channels";
        case 1:
            return "named like a finished picture";
        default:
            return "the first of " + std::to_string(candidates) + " colour layers; read.layer overrides";
    }
}

ColourChoice choice_of(const Group& g) {
    const auto name = [&](const char* base) {
        const auto found = g.channel.find(base);
        return found == g.channel.end() ? std::string() : found->second;
    };
    ColourChoice c;
    c.part = g.part, c.layer = g.layer, c.view = g.view;
    c.alpha = name("a");
    if (g.has("r") && g.has("g") && g.has("b")) {
        c.red = name("r"), c.green = name("g"), c.blue = name("b");
    } else if (g.has("y")) {
        c.luminance = name("y"), c.chroma_r = name("ry"), c.chroma_b = name("by");
    }
    return c;
}

const char* type_name(SampleType type) {
    return type == SampleType::Half ? "half" : type == SampleType::Float ? "float" : "uint";
}

std::string line_of(const ColourChoice& c, const Part& part, const std::string& why,
                    bool coverage_per_colour) {
    std::vector<std::string> names;
    for (const std::string& n : {c.red, c.green, c.blue, c.luminance, c.chroma_r, c.chroma_b, c.alpha})
        if (!n.empty()) names.push_back(n);
    std::string line = "colour: " + joined(names, " ");
    if (const Channel* first = part.find(names.front()))
        line += std::string(" (") + type_name(first->type) + ")";
    if (!part.title.empty()) line += " of " + part.title;
    line += ": " + why;
    if (c.is_luminance())
        line += c.chroma_r.empty() ? "; luminance only, read as grey" : "; luminance and chroma";
    if (c.alpha.empty()) line += "; no alpha, taken as opaque";
    if (coverage_per_colour) line += " (RA, GA, BA are not used)";
    return line;
}

}  // namespace

Result<ColourChoice> choose_colour(const std::string& path, const Layout& layout,
                                   const ReadOptions& options) {
    std::vector<Group> candidates = groups_of(layout);
    std::erase_if(candidates, [&](const Group& g) { return !g.is_colour(layout.parts[g.part].deep); });
    const std::size_t with_data = candidates.size();
    if (options.layer.empty())
        std::erase_if(candidates, [&](const Group& g) { return rank(g, layout.parts[g.part]) == kData; });
    if (candidates.empty()) {
        std::vector<std::string> names;
        for (const Part& p : layout.parts)
            for (const Channel& c : p.channels) names.push_back(c.name);
        const char* hint = with_data ? "its layers hold other data, read.layer takes one all the same"
                                     : "R, G, B or Y are needed";
        return invalid_file(path,
                            std::string("has no colour: ") + hint + "; its channels are " + listed(names));
    }
    Result<std::vector<Group>> of_layer = of_wanted_layer(path, layout, options.layer, candidates);
    if (!of_layer) return of_layer.error();
    Result<std::vector<Group>> of_view = of_wanted_view(path, layout, options.view_name, *of_layer);
    if (!of_view) return of_view.error();
    const std::string default_view = layout.views.empty() ? "" : layout.views.front();
    const auto order = [&](const Group& g) {
        const Part& part = layout.parts[g.part];
        return std::tuple(rank(g, part), g.view != default_view, g.has("r") ? 0 : 1, g.part);
    };
    const Group& best =
        *std::min_element(of_view->begin(), of_view->end(),
                          [&](const Group& p, const Group& q) { return order(p) < order(q); });
    const Part& part = layout.parts[best.part];
    ColourChoice choice = choice_of(best);
    choice.line = line_of(choice, part, reason(best, part, options, candidates.size()), best.has("ra"));
    return choice;
}

}  // namespace petzval
