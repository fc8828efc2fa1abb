#include "petzval/names.h"

#include "files/channels/channel_choice.h"
#include "files/channels/channel_groups.h"
#include "files/wording.h"

#include <algorithm>
#include <tuple>

namespace petzval {
namespace {

bool is_one_of(const std::string& name, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

// The finished picture, as renderers and compositors name it.
bool is_beauty_name(const std::string& name) {
    return is_one_of(name, {"combined", "beauty", "rgba", "rgb", "image", "color", "colour", "c", "main",
                            "final", "composite", "rgb_color", "bty"});
}

constexpr int kData = 4;
// Smaller is a better guess.
int rank(const ChannelGroup& g, const Part& part) {
    const std::string name = name_of_layer(g, part);
    if (is_data_name(name)) return kData;
    if (g.layer.empty() && (name.empty() || is_beauty_name(name))) return 0;
    if (is_beauty_name(name)) return 1;
    return g.layer.empty() ? 2 : 3;
}

Result<std::vector<ChannelGroup>> of_wanted_view(const std::string& path, const Layout& layout,
                                                 const std::string& view, std::vector<ChannelGroup> groups) {
    if (view.empty()) return groups;
    std::vector<ChannelGroup> kept;
    for (const ChannelGroup& g : groups)
        if (lower(g.view) == lower(view)) kept.push_back(g);
    if (kept.empty())
        return Error{ErrorCode::InvalidArgument, printable(path, 4096) + ": has no view '" + printable(view) +
                                                     "' with colour; views: " + listed(layout.views)};
    return kept;
}

// Advice for a layer that exists but holds no colour. "" if the layer does not exist.
std::string what_of_no_colour(const Layout& layout, const std::string& layer) {
    for (const ChannelGroup& g : groups_of(layout)) {
        const auto is_channel = [&](const auto& channel) { return lower(channel.second) == lower(layer); };
        if (!is_called(g, layout.parts[g.part], layer) &&
            std::none_of(g.channel.begin(), g.channel.end(), is_channel))
            continue;
        const std::string no_colour = "; '" + printable(layer) + "' holds no colour";
        if (is_data_name(name_of_layer(g, layout.parts[g.part]))) return no_colour;
        return no_colour + ": read.layers " + printable(layer) + " blurs it beside the picture";
    }
    return "";
}

Result<std::vector<ChannelGroup>> of_wanted_layer(const std::string& path, const Layout& layout,
                                                  const std::string& layer,
                                                  std::vector<ChannelGroup> groups) {
    if (layer.empty()) return groups;
    std::vector<ChannelGroup> kept;
    for (const ChannelGroup& g : groups)
        if (is_called(g, layout.parts[g.part], layer)) kept.push_back(g);
    if (!kept.empty()) return kept;
    std::vector<std::string> names = names_to_type(groups, layout);
    std::erase(names, kUnnamed);
    return Error{ErrorCode::InvalidArgument,
                 printable(path, 4096) + ": has no colour layer or part '" + printable(layer) + "'" +
                     did_you_mean(layer, names) +
                     (names.empty() ? "; its colour has no name and is read by default"
                                    : "; it has " + listed(names)) +
                     what_of_no_colour(layout, layer)};
}

std::string reason(const ChannelGroup& g, const Part& part, const ReadOptions& options,
                   std::size_t candidates) {
    if (!options.layer.empty()) return "asked for with read.layer";
    if (candidates == 1) return "the file's only colour";
    switch (rank(g, part)) {
        case 0:
            return "the plain channels";
        case 1:
            return "named like a finished picture";
        default:
            return "the first of " + std::to_string(candidates) + " colour layers; read.layer overrides";
    }
}

ColourChoice choice_of(const ChannelGroup& g) {
    const auto name = [&](const char* base) {
        const auto found = g.channel.find(base);
        return found == g.channel.end() ? std::string() : found->second;
    };
    ColourChoice c;
    c.part = g.part, c.layer = g.layer, c.view = g.view;
    c.alpha = name("a");
    if (g.is_rgb()) {
        c.red = name("r"), c.green = name("g"), c.blue = name("b");
    } else if (g.has("y")) {
        c.luminance = name("y"), c.chroma_r = name("ry"), c.chroma_b = name("by");
    }
    return c;
}

const char* type_name(ChannelType type) {
    return type == ChannelType::Half ? "half" : type == ChannelType::Float ? "float" : "uint";
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
    std::vector<ChannelGroup> candidates = groups_of(layout);
    std::erase_if(candidates, [&](const ChannelGroup& g) {
        return !g.is_colour(layout.parts[g.part].deep || !options.need_colour);
    });
    const std::size_t with_data = candidates.size();
    if (options.layer.empty())
        std::erase_if(candidates,
                      [&](const ChannelGroup& g) { return rank(g, layout.parts[g.part]) == kData; });
    if (candidates.empty()) {
        std::vector<std::string> names;
        for (const Part& p : layout.parts)
            for (const Channel& c : p.channels) names.push_back(c.name);
        const char* hint = with_data ? "its layers hold other data; read.layer can still choose one"
                                     : "all of R, G and B are needed, or Y";
        return invalid_file(path,
                            std::string("has no colour: ") + hint + "; its channels are " + listed(names));
    }
    Result<std::vector<ChannelGroup>> of_layer = of_wanted_layer(path, layout, options.layer, candidates);
    if (!of_layer) return of_layer.error();
    Result<std::vector<ChannelGroup>> of_view = of_wanted_view(path, layout, options.view_name, *of_layer);
    if (!of_view) return of_view.error();
    const std::string default_view = layout.views.empty() ? "" : layout.views.front();
    const auto order = [&](const ChannelGroup& g) {
        const Part& part = layout.parts[g.part];
        return std::tuple(rank(g, part), g.view != default_view, g.has("r") ? 0 : 1, g.part);
    };
    const ChannelGroup& best =
        *std::min_element(of_view->begin(), of_view->end(),
                          [&](const ChannelGroup& p, const ChannelGroup& q) { return order(p) < order(q); });
    const Part& part = layout.parts[best.part];
    ColourChoice choice = choice_of(best);
    choice.line = line_of(choice, part, reason(best, part, options, candidates.size()), best.has("ra"));
    return choice;
}

}  // namespace petzval
