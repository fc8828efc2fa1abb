// The window of the contact sheet: the picture through many lenses or presets; a click chooses one.
#include "commands.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <imgui.h>
#include <string>

namespace petzval::view {
namespace {

ImTextureID id_of(const Texture& texture) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t(texture.name()));  // NOLINT: as the backend has it
}

void choose(App& app, const SheetEntry& entry) {
    for (const std::string& line : entry.commands) static_cast<void>(act(app, line));
}

// One entry: its picture, or a frame with the reason why there is none, and its label.
void draw_tile(App& app, const SheetTile& tile, const ImVec2& size) {
    ImGui::BeginGroup();
    const ImVec2 from = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton(("tile " + tile.entry.label).c_str(), size)) choose(app, tile.entry);
    is_field(app, "tile " + tile.entry.label);
    const bool is_hovered = ImGui::IsItemHovered();
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 to{from.x + size.x, from.y + size.y};
    list->AddRectFilled(from, to, IM_COL32(30, 30, 30, 255));
    if (!tile.texture.empty()) list->AddImage(id_of(tile.texture), from, to);
    if (is_hovered) list->AddRect(from, to, IM_COL32(255, 220, 90, 255), 0, 0, 2);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + size.x);
    ImGui::TextUnformatted(tile.entry.label.c_str());
    if (!tile.error.empty()) ImGui::TextDisabled("%s", tile.error.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndGroup();
}

// The fewest columns that show all tiles at once; tiles stay wider than 12 letters.
int columns_of(int tiles, float shape, const ImVec2& room) {
    const float label = 1.5f * ImGui::GetTextLineHeightWithSpacing();
    const int most = std::max(1, int(room.x / (12 * ImGui::GetFontSize())));
    for (int columns = 1; columns < most; ++columns) {
        const float high = shape * room.x / float(columns) + label;
        if (float((tiles + columns - 1) / columns) * high < room.y) return columns;
    }
    return most;
}

}  // namespace

void draw_sheet(App& app) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float letter = ImGui::GetFontSize();
    const float panel = app.state.panels ? std::min(26 * letter, 0.6f * size.x) : 0;
    ImGui::SetNextWindowPos({letter, letter}, ImGuiCond_Appearing);
    ImGui::SetNextWindowSize({size.x - panel - 2 * letter, size.y - 6 * letter}, ImGuiCond_Appearing);
    ImGui::SetNextWindowBgAlpha(1);
    bool open = true;
    if (ImGui::Begin("This picture, many looks", &open,
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
        ImGui::TextWrapped("click one to use it; Ctrl+Z undoes it");
        const Rect frame = app.frame();
        const float shape = frame.empty() ? 0.6f : float(frame.height()) / float(frame.width());
        const int columns = columns_of(int(app.sheet_tiles().size()), shape, ImGui::GetContentRegionAvail());
        const float wide =
            ImGui::GetContentRegionAvail().x / float(columns) - ImGui::GetStyle().ItemSpacing.x;
        const float high = shape * wide;
        int count = 0;
        for (const auto& tile : app.sheet_tiles()) {
            if (count++ % columns != 0) ImGui::SameLine();
            draw_tile(app, *tile, {wide, high});
        }
    }
    ImGui::End();
    if (!open) static_cast<void>(act(app, "sheet off"));
}

}  // namespace petzval::view
