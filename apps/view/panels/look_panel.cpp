// The panel Look: a few fields that everyone uses, and all the others in groups.
#include "fields.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <imgui.h>
#include <string>
#include <vector>

namespace petzval::view {
namespace {

const std::vector<std::string>& basic_fields() {
    static const std::vector<std::string> fields{"lens.name",     "lens.blades",  "lens.blade_rotation_deg",
                                                 "lens.cats_eye", "lens.squeeze", "glare.bloom",
                                                 "glare.star",    "engine",       "quality"};
    return fields;
}

bool is_basic(const std::string& path) {
    const auto& basic = basic_fields();
    return std::find(basic.begin(), basic.end(), path) != basic.end();
}

// Groups of other engines than the look's change nothing.
bool has_effect(const App& app, const FieldRow& row) {
    const std::string& engine = app.state.choice.look.engine;
    if (row.path == "pupil_points") return engine == "reference";
    constexpr std::string_view kOfEngine = "Engine ";
    if (!row.heading.starts_with(kOfEngine)) return true;
    const std::string of = row.heading.substr(kOfEngine.size());
    return of == engine || (of == "gather" && (engine == "realtime" || engine == "sprites"));
}

void draw_groups(App& app) {
    std::string heading;
    bool open = false;
    for (const FieldRow& row : app.setup().fields) {
        if (is_basic(row.path) || !has_effect(app, row)) continue;
        if (row.heading != heading) {
            if (open) ImGui::TreePop();
            heading = row.heading;
            open = ImGui::TreeNode(heading.c_str());
            is_field(app, "heading " + heading);
        }
        if (open) row_widget(app, row);
    }
    if (open) ImGui::TreePop();
}

}  // namespace

void look_panel(App& app) {
    for (const std::string& path : basic_fields())
        for (const FieldRow& row : app.setup().fields)
            if (row.path == path) row_widget(app, row);
    const bool open = ImGui::TreeNode("Advanced");
    is_field(app, "heading Advanced", "all fields; those of engines not in use are hidden");
    if (!open) return;
    draw_groups(app);
    ImGui::TreePop();
}

}  // namespace petzval::view
