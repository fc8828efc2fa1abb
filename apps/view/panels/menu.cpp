// The menu bar: files, undo. And the window in which a file is chosen.
#include "commands.h"
#include "fields.h"
#include "panels.h"
#include "recent.h"
#include "widgets.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <imgui.h>
#include <map>
#include <string>
#include <vector>

namespace petzval::view {
namespace {

namespace fs = std::filesystem;

void say(App& app, const std::string& line) { static_cast<void>(act(app, line)); }

void item(App& app, const char* label, const char* key, const std::string& line, bool can = true) {
    if (ImGui::MenuItem(label, key, false, can)) say(app, line);
    is_field(app, std::string("menu ") + label);
}

bool is_picture(const fs::path& path) {
    std::string end = path.extension().string();
    std::transform(end.begin(), end.end(), end.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    for (const char* known : {".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff"})
        if (end == known) return true;
    return false;
}

// Folders first, then pictures, by name. Frames of a shot are one entry, such as shot.####.exr.
struct Entry {
    std::string name;
    int frames = 0;  // 0: a single picture
};
struct Listing {
    fs::path folder;
    std::vector<std::string> folders;
    std::vector<Entry> pictures;
};

// ImGui takes ## as the beginning of a name that is not shown: a####.exr becomes a%04d.exr, which means the
// same.
std::string readable(const std::string& pattern) {
    const std::size_t begin = pattern.find('#');
    if (begin == std::string::npos) return pattern;
    const std::size_t end = std::min(pattern.find_first_not_of('#', begin), pattern.size());
    return pattern.substr(0, begin) + "%0" + std::to_string(end - begin) + "d" + pattern.substr(end);
}

// The name with # for each digit of its frame number, the last digits before the ending; empty: it has none.
std::string frame_pattern(const std::string& name) {
    std::size_t end = name.rfind('.');
    std::size_t begin = end;
    while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1]))) --begin;
    if (begin == end || begin == 0) return "";
    return name.substr(0, begin) + std::string(end - begin, '#') + name.substr(end);
}

std::vector<Entry> with_shots(const std::vector<std::string>& names) {
    std::map<std::string, int> frames;
    for (const std::string& name : names) ++frames[frame_pattern(name)];
    std::vector<Entry> pictures;
    for (const std::string& name : names) {
        const std::string pattern = frame_pattern(name);
        if (pattern.empty() || frames[pattern] < 2)
            pictures.push_back({name, 0});
        else if (pictures.empty() || pictures.back().name != pattern)
            pictures.push_back({pattern, frames[pattern]});
    }
    return pictures;
}

Listing listing_of(const fs::path& folder) {
    constexpr std::size_t kMost = 5000;
    Listing listing{folder, {}, {}};
    std::vector<std::string> pictures;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        const std::string name = at->path().filename().string();
        std::error_code ignored;
        if (name.starts_with(".")) continue;
        if (at->is_directory(ignored))
            listing.folders.push_back(name);
        else if (is_picture(at->path()))
            pictures.push_back(name);
        if (listing.folders.size() + pictures.size() >= kMost) break;
    }
    std::sort(listing.folders.begin(), listing.folders.end());
    std::sort(pictures.begin(), pictures.end());
    listing.pictures = with_shots(pictures);
    return listing;
}

fs::path start_folder(const App& app) {
    std::error_code failed;
    const fs::path of_shot = fs::absolute(app.state.choice.input.path, failed).parent_path();
    return fs::is_directory(of_shot, failed) ? of_shot : fs::current_path(failed);
}

void draw_listing(App& app, Listing& shown, char* typed, std::size_t size) {
    fs::path next;
    if (ImGui::Selectable("..")) next = shown.folder.parent_path();
    for (const std::string& name : shown.folders)
        if (ImGui::Selectable((name + "/").c_str())) next = shown.folder / name;
    for (const auto& [name, frames] : shown.pictures) {
        const std::string label =
            frames > 0 ? readable(name) + "   " + std::to_string(frames) + " frames" : name;
        if (ImGui::Selectable(label.c_str())) {
            std::strncpy(typed, (shown.folder / name).string().c_str(), size - 1);
            say(app, "open \"" + std::string(typed) + "\"");
            if (app.error.empty()) say(app, "set view.open off");
        }
        is_field(app, "file " + name);
    }
    if (!next.empty()) shown = listing_of(next);
}

}  // namespace

void draw_menu(App& app) {
    if (!ImGui::BeginMenuBar()) return;
    const bool files = ImGui::BeginMenu("File");
    is_field(app, "menu File");
    if (files) {
        item(app, "Open…", "Ctrl+O", "set view.open on");
        const std::vector<std::string> recent = recent_files();
        if (ImGui::BeginMenu("Open recent", !recent.empty())) {
            for (const std::string& path : recent)
                if (ImGui::MenuItem(readable(path).c_str())) say(app, "open \"" + path + "\"");
            ImGui::EndMenu();
        }
        item(app, "Reload", "Ctrl+R", "reload", app.shot() != nullptr);
        item(app, "Copy command", "Ctrl+C", "copy", app.shot() != nullptr);
        item(app, "Quit", "Ctrl+Q", "quit");
        ImGui::EndMenu();
    }
    const bool edit = ImGui::BeginMenu("Edit");
    is_field(app, "menu Edit");
    if (edit) {
        item(app, "Undo", "Ctrl+Z", "undo");
        item(app, "Redo", "Ctrl+Shift+Z", "redo");
        item(app, "Reset the look", "", "reset look");
        ImGui::EndMenu();
    }
    const bool view = ImGui::BeginMenu("View");
    is_field(app, "menu View");
    if (view) {
        item(app, "Lens bench", "L", "toggle view.lens");
        item(app, "Focus overlay", "O", "toggle view.overlay");
        item(app, "Compare", "W", "wipe toggle");
        item(app, "Final quality", "Enter", "toggle view.final");
        item(app, "Fit", "F", "zoom fit");
        item(app, "Keys", "H", "toggle view.help");
        ImGui::EndMenu();
    }
    ImGui::EndMenuBar();
}

void draw_open(App& app) {
    static Listing shown;
    static char typed[1024] = "";
    if (shown.folder.empty()) shown = listing_of(start_folder(app));
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(0.9f * size.x, 44 * ImGui::GetFontSize()), 0.8f * size.y});
    ImGui::SetNextWindowBgAlpha(1);
    bool open = true;
    if (ImGui::Begin("Open a picture", &open,
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse)) {
        ImGui::TextWrapped("%s", shown.folder.string().c_str());
        ImGui::SetNextItemWidth(-6 * ImGui::GetFontSize());
        const bool enter = ImGui::InputTextWithHint("##path", "a file, or shot.####.exr", typed, sizeof typed,
                                                    ImGuiInputTextFlags_EnterReturnsTrue);
        is_field(app, "open path");
        ImGui::SameLine();
        if ((ImGui::Button("open") || enter) && typed[0] != 0) {
            say(app, "open \"" + std::string(typed) + "\"");
            open = !app.error.empty();
        }
        if (ImGui::BeginChild("files")) draw_listing(app, shown, typed, sizeof typed);
        ImGui::EndChild();
    }
    ImGui::End();
    if (!open) say(app, "set view.open off");
    if (!app.state.opening) shown = {};
}

}  // namespace petzval::view
