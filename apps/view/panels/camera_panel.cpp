// The panel Camera: what the file says, what is assumed, what was chosen.
#include "petzval/names.h"

#include "commands.h"
#include "fields.h"
#include "input.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <imgui.h>
#include <string>

namespace petzval::view {
namespace {

void say(App& app, const std::string& line) { static_cast<void>(act(app, line)); }

// Cameras of a file that has several.
void own_cameras(App& app) {
    if (!app.shot() || app.shot()->cameras.size() < 2) return;
    const std::string now = field_text(app, "scene.camera").value();
    if (ImGui::BeginCombo("camera", now.c_str())) {
        for (const std::string& name : app.shot()->cameras)
            if (ImGui::Selectable(name.c_str(), name == now)) say(app, "set scene.camera \"" + name + "\"");
        ImGui::EndCombo();
    }
    is_field(app, "scene.camera");
}

// A number that nothing gave stands in amber, and is called assumed.
void camera_number(App& app, const char* field, const char* label, const std::optional<FoundNumber>& found,
                   const Ends& ends) {
    const bool assumed = is_assumed(found);
    const std::string name = std::string("camera.") + field;
    const auto origin = [&] {  // a field names itself as the origin of its value
        return found->origin == name ? "set by hand" : "from: " + found->origin;
    };
    if (assumed) ImGui::PushStyleColor(ImGuiCol_Text, kAmber);
    slider_widget(app, name, assumed ? std::string(label) + " (assumed)" : label, ends,
                  found ? origin() + "; right click: the number of the file" : "");
    if (assumed) ImGui::PopStyleColor();
}

}  // namespace

void camera_panel(App& app) {
    own_cameras(app);
    const FoundCamera found = app.found_camera();
    const DepthHistogram* depth = app.shot() ? &app.shot()->histogram : nullptr;
    const bool has_depth = depth && !depth->counts.empty() && depth->farthest_m > depth->nearest_m;
    camera_number(app, "f_number", "f-number", found.f_number, {0.7, 22, "f/%.3g", true});
    if (app.shot() && app.shot()->shot.has_radii())
        ImGui::TextWrapped("the file has blur radii, which include aperture and focus");
    camera_number(app, "focus_distance_m", "focus", found.focus_distance_m,
                  {has_depth ? depth->nearest_m : 0.1, has_depth ? depth->farthest_m : 100, "%.4g m", true});
    camera_number(app, "focal_length_mm", "focal length", found.focal_length_mm, {8, 400, "%.4g mm", true});
    camera_number(app, "sensor_width_mm", "sensor width", found.sensor_width_mm, {4, 70, "%.4g mm", true});
    const ImageScale scale = app.state.choice.camera.image_scale;
    const auto called = [](ImageScale one) { return one == ImageScale::Rendered ? "off" : "on"; };
    if (ImGui::BeginCombo("focus breathing", called(scale))) {
        for (const auto& known : names<ImageScale>())
            if (ImGui::Selectable(called(known.value), known.value == scale))
                say(app, std::string("set camera.image_scale ") + known.name);
        ImGui::EndCombo();
    }
    if (ImGui::Button("reset to file"))
        for (const char* number : {"f_number", "focus_distance_m", "focal_length_mm", "sensor_width_mm"})
            say(app, std::string("set camera.") + number + " file");
}

}  // namespace petzval::view
