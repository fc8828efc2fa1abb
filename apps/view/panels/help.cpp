// All keys, on one sheet.
#include "commands.h"
#include "panels.h"

#include <cctype>
#include <imgui.h>
#include <map>
#include <string>

namespace petzval::view {
namespace {

// "shift+slash" as it stands on the key: "?".
std::string cap_of(const std::string& key) {
    static const std::map<std::string, std::string> signs{
        {"period", "."}, {"comma", ","}, {"equal", "+ or ="}, {"minus", "-"}, {"shift+slash", "?"}};
    if (const auto sign = signs.find(key); sign != signs.end()) return sign->second;
    std::string cap = key;
    bool begins = true;
    for (char& c : cap) {
        if (begins) c = char(std::toupper(static_cast<unsigned char>(c)));
        begins = c == '+';
    }
    return cap;
}

void row_of(const Binding& binding) {
    ImGui::TableNextColumn();
    ImGui::TextColored({1, 0.86f, 0.35f, 1}, "%s", cap_of(binding.key).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted((binding.meaning + "    ").c_str());
}

}  // namespace

void draw_help(App& app) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({1, 1}, {0.96f * size.x, 0.96f * size.y});
    ImGui::SetNextWindowBgAlpha(1);
    bool open = true;
    if (ImGui::Begin("Help", &open,
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_HorizontalScrollbar)) {
        ImGui::TextUnformatted(app.is_live()
                                   ? "click: focus     drag: turn the camera     wheel: zoom"
                                   : "click or drag: focus     right click: inspect a pixel     wheel: zoom");
        ImGui::TextUnformatted("middle or right drag: pan     Ctrl-click a number: type a value");
        ImGui::Separator();
        const auto& all = bindings();
        const std::size_t rows = (all.size() + 1) / 2;
        if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
            for (std::size_t i = 0; i < rows; ++i) {
                row_of(all[i]);
                if (rows + i < all.size()) row_of(all[rows + i]);
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
    if (!open) static_cast<void>(act(app, "set view.help off"));
}

}  // namespace petzval::view
