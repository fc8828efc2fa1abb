#include "files/channels/motion_choice.h"

#include "files/wording.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace petzval {
namespace {

// All channels of one layer and view in one part.
struct Group {
    std::size_t part = 0;
    std::string layer, view;                      // as written
    std::string name;                             // lower case, last component, or the part's label
    std::map<std::string, std::string> channels;  // base in lower case -> name

    bool has(const char* base) const { return channels.contains(base); }
};

std::vector<Group> groups_of_view(const Layout& layout, const std::string& view) {
    std::vector<Group> groups;
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        const Part& part = layout.parts[p];
        if (!part.readable || part.deep) continue;
        for (const Channel& c : part.channels) {
            if (c.subsampled() || (!c.view.empty() && !view.empty() && c.view != view)) continue;
            const auto same = [&](const Group& g) {
                return g.part == p && g.layer == c.layer && g.view == c.view;
            };
            auto group = std::find_if(groups.begin(), groups.end(), same);
            if (group == groups.end()) {
                const std::string whole = c.layer.empty() ? part.label : c.layer;
                const std::size_t dot = whole.rfind('.');
                groups.push_back({p,
                                  c.layer,
                                  c.view,
                                  lower(dot == std::string::npos ? whole : whole.substr(dot + 1)),
                                  {}});
                group = groups.end() - 1;
            }
            group->channels[lower(c.base)] = c.name;
        }
    }
    return groups;
}

bool is_blenders(const Group& g) { return g.has("x") && g.has("y") && g.has("z") && g.has("w"); }

std::optional<VectorChoice> vector_of(const Group& g) {
    using Pair = std::array<const char*, 2>;
    for (const auto& [x, y] : {Pair{"u", "v"}, {"x", "y"}, {"r", "g"}, {"red", "green"}})
        if (g.has(x) && g.has(y)) return VectorChoice{g.part, g.channels.at(x), g.channels.at(y)};
    return std::nullopt;
}

bool is_single_name(const std::string& name) {
    const auto names = {"motionvector", "motionvectors", "motion_vector", "motion_vectors", "motion",
                        "velocity",     "vrayvelocity",  "vector",        "vectors",        "mv"};
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return name == n; });
}

MotionChoice blenders(const Group& g) {
    const auto& c = g.channels;
    MotionChoice choice;
    choice.to_previous = VectorChoice{g.part, c.at("x"), c.at("y"), 1, -1};
    choice.to_next = VectorChoice{g.part, c.at("z"), c.at("w"), -1, 1};
    choice.line = "motion: " + printable(c.at("x")) + " Y Z W: to the frames before and after";
    return choice;
}

// forward and backward, of the part that has more of them.
MotionChoice both_ways(const std::vector<Group>& groups) {
    MotionChoice choice;
    for (const Group& g : groups) {
        std::optional<VectorChoice>& way = g.name == "forward" ? choice.to_next : choice.to_previous;
        if ((g.name == "forward" || g.name == "backward") && !way) way = vector_of(g);
    }
    const auto named = [](const std::optional<VectorChoice>& v) {
        return v ? printable(v->x) + ", " + printable(v->y) : "";
    };
    const bool both = choice.to_next && choice.to_previous;
    choice.line = "motion: " + named(choice.to_next) + (both ? " and " : "") + named(choice.to_previous) +
                  (both             ? ": to the frames after and before"
                   : choice.to_next ? ": to the frame after"
                                    : ": to the frame before");
    return choice;
}

MotionChoice single(const VectorChoice& v) {
    return {std::nullopt, v,
            "motion: " + printable(v.x) + ", " + printable(v.y) + ": read as the motion to the next frame"};
}

Result<std::optional<MotionChoice>> named(const std::string& path, const Layout& layout,
                                          const std::vector<Group>& groups, const std::string& wanted) {
    std::vector<std::string> names;
    for (const Group& g : groups) {
        const std::string& part = layout.parts[g.part].label;
        const std::string name = g.layer.empty() ? part : g.layer;
        if (!name.empty() && (is_blenders(g) || vector_of(g))) names.push_back(name);
        if (lower(wanted) != lower(name) && lower(wanted) != g.name && lower(wanted) != lower(part)) continue;
        if (is_blenders(g)) return std::optional(blenders(g));
        if (g.name == "forward" || g.name == "backward") return std::optional(both_ways({g}));
        if (const auto v = vector_of(g)) return std::optional(single(*v));
    }
    return Error{ErrorCode::InvalidArgument,
                 printable(path, 4096) + ": has no motion layer '" + printable(wanted) +
                     "' (read.motion.layer); " +
                     (names.empty() ? "no layer has channels X, Y, Z, W or u, v or x, y or R, G"
                                    : "its motion layers: " + listed(names)),
                 "read.motion.layer"};
}

}  // namespace

Result<std::optional<MotionChoice>> choose_motion(const std::string& path, const Layout& layout,
                                                  const ColourChoice& colour, const MotionReading& reading) {
    const std::vector<Group> groups = groups_of_view(layout, colour.view);
    if (!reading.layer.empty()) return named(path, layout, groups, reading.layer);
    for (const Group& g : groups)
        if (g.name == "vector" && is_blenders(g)) return std::optional(blenders(g));
    if (MotionChoice found = both_ways(groups); found.to_next || found.to_previous)
        return std::optional(std::move(found));
    for (const Group& g : groups)
        if (const auto v = vector_of(g); v && is_single_name(g.name)) return std::optional(single(*v));
    return std::optional<MotionChoice>();
}

}  // namespace petzval
