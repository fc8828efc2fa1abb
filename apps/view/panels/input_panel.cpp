// The panel Input: colour layer, view, depth and its meaning.
#include "petzval/names.h"

#include "commands.h"
#include "fields.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <cstring>
#include <imgui.h>
#include <set>
#include <string>
#include <vector>

namespace petzval::view {
namespace {

struct Offers {
    std::set<std::string> layers, views, channels;
};

// Names that the file's parts have: "diffuse.R half" is the channel diffuse.R of the layer diffuse.
Offers offers_of(const Shot& shot) {
    Offers offers;
    offers.views.insert(shot.views.begin(), shot.views.end());
    for (const PartSummary& part : shot.parts) {
        if (!part.view.empty()) offers.views.insert(part.view);
        if (shot.parts.size() > 1 && !part.name.empty()) offers.layers.insert(part.name);
        for (const std::string& words : part.channels) {
            const std::string channel = words.substr(0, words.find(' '));
            const std::size_t dot = channel.rfind('.');
            const std::string last = channel.substr(dot == std::string::npos ? 0 : dot + 1);
            if (dot != std::string::npos && (last == "R" || last == "r"))
                offers.layers.insert(channel.substr(0, dot));
            offers.channels.insert(channel);
        }
    }
    return offers;
}

void set_it(App& app, const std::string& path, const std::string& value) {
    static_cast<void>(act(app, "set " + path + " \"" + value + "\""));
}

void one_of(App& app, const char* label, const std::string& path, const std::set<std::string>& names,
            const char* help) {
    const std::string now = field_text(app, path).value();
    if (names.empty() && now == "file") return;
    if (ImGui::BeginCombo(label, now == "file" ? "automatic" : now.c_str())) {
        if (ImGui::Selectable("automatic", now == "file")) set_it(app, path, "file");
        for (const std::string& name : names)
            if (ImGui::Selectable(name.c_str(), name == now)) set_it(app, path, name);
        ImGui::EndCombo();
    }
    is_field(app, path, help);
}

void typed(App& app, const char* label, const std::string& path, const char* hint, const char* help) {
    const std::string now = field_text(app, path).value();
    char text[512] = {};
    if (now != "file") std::strncpy(text, now.c_str(), sizeof text - 1);
    ImGui::InputTextWithHint(label, hint, text, sizeof text);
    is_field(app, path, help);
    if (ImGui::IsItemDeactivatedAfterEdit()) set_it(app, path, text[0] == 0 ? "file" : text);
}

void kind_of_depth(App& app) {
    std::set<std::string> kinds;
    for (const auto& known : names<DepthKind>()) kinds.insert(known.name);
    one_of(
        app, "depth is", "input.depth_kind", kinds,
        "planar: distance along the axis; ray: from the camera; inverse: 1/planar or disparity; normalized, "
        "device, mist: 0 to 1 within the range; coc-px: blur radii in pixels");
    const auto& kind = app.state.choice.input.depth_kind;
    if (kind && *kind != DepthKind::Planar && *kind != DepthKind::Ray)
        typed(app, "depth range", "input.depth_range", "NEAR,FAR", "ends of the depth, such as 0.1,100");
    typed(app, "metres per unit", "input.unit_scale_m", "1", "0.01 for a scene in centimetres");
}

}  // namespace

void input_panel(App& app) {
    const OpenShot& open = *app.shot();
    if (!open.no_depth.empty() || open.shot.depth_plane().empty()) {
        const std::string why =
            open.no_depth.empty() ? "this picture has no depth" : plain_words(app, open.no_depth);
        ImGui::PushStyleColor(ImGuiCol_Text, kAmber);
        ImGui::TextWrapped("%s", why.c_str());
        ImGui::PopStyleColor();
        ImGui::TextWrapped("The sharp picture is shown. Choose a depth channel or a file with depth.");
    }
    const Offers offers = offers_of(open.shot);
    one_of(app, "colour layer", "input.layer", offers.layers, "layer or part whose colour is blurred");
    one_of(app, "view", "input.view", offers.views, "view of a stereo file");
    one_of(app, "depth channel", "input.depth_channel", offers.channels, "channel that holds the depth");
    typed(app, "depth file", "input.depth_file", "same file", "another file that holds the depth");
    kind_of_depth(app);
    for (const std::string& line : open.shot.detected) ImGui::TextWrapped("%s", line.c_str());
}

}  // namespace petzval::view
