#include "app.h"
#include "commands.h"
#include "fields.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <optional>
#include <string>
#include <vector>

namespace petzval::view {
namespace {

void say(App& app, const std::string& line) { static_cast<void>(act(app, line)); }

void flowing_switch(App& app, const char* label, const char* field) {
    flow(ImGui::CalcTextSize(label).x + ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x);
    switch_widget(app, field, label);
}

void draw_buttons(App& app) {
    const Timeline& line = app.state.timeline;
    const auto button = [&](const char* label, const std::string& command, const char* help = "") {
        if (flowing_button(label)) say(app, command);
        is_field(app, label, help);
    };
    ImGui::AlignTextToFramePadding();
    ImGui::Text("frame %d of %d … %d", line.frame, line.frames.front(), line.frames.back());
    if (const auto focus = line.focus_at(line.frame)) {
        ImGui::SameLine();
        ImGui::TextColored({1, 0.86f, 0.35f, 1}, "focus %.4g m", *focus);
    }
    button(line.playing ? "stop" : "play", "toggle shot.playing",
           "Shift-drag on the line below sets the range that is played");
    button(line.rack_clicks > 0 ? "stop rack" : "rack", "rack",
           "click the subject in the first frame of the range, then the subject in the last");
    button("set key", "key_focus");
    button("remove key", "remove_key");
    flowing_switch(app, "click sets key", "shot.keying");
    flowing_switch(app, "eased", "shot.easing");
    const float number = 4 * ImGui::GetFontSize();
    flow(number + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize("max. dioptres/frame").x);
    ImGui::SetNextItemWidth(number);
    number_widget(app, "shot.focus_speed", "max. dioptres/frame", 0.002, false);
    button("save track", "save_track track.csv", "track.csv, for defocus --track");
    button("load track", "load_track track.csv", "track.csv");
    if (!app.is_live()) return;
    flowing_switch(app, "record camera", "scene.recording");
    button("save path", "save_path path.csv", "path of the camera, path.csv");
    button("load path", "load_path path.csv", "path.csv");
}

// Mapping of frames and distances to the panel. Up is near, in even steps of dioptres.
struct Graph {
    ImVec2 from, size;
    double begin = 0, span = 1, most_dpt = 1e-6;

    float x(double frame) const { return from.x + float((frame - begin + 0.5) / (span + 1)) * size.x; }
    float y(double metres) const { return from.y + size.y * float(0.72 - 0.6 / metres / most_dpt); }
    double frame(float x) const { return double((x - from.x) / size.x) * (span + 1) + begin - 0.5; }
    double metres(float y) const {
        const double dpt = (0.72 - double((y - from.y) / size.y)) / 0.6 * most_dpt;
        return 1 / std::max(dpt, 1e-4 * most_dpt);
    }
};

int nearest_frame(const Timeline& line, double at) {
    return *std::min_element(line.frames.begin(), line.frames.end(),
                             [&](int a, int b) { return std::abs(a - at) < std::abs(b - at); });
}

// The key whose diamond is under the pointer.
std::optional<int> key_under_pointer(const Timeline& line, const Graph& graph) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float reach = 0.6f * ImGui::GetFontSize();
    for (const auto& [frame, metres] : line.keys)
        if (std::abs(mouse.x - graph.x(frame)) < reach && std::abs(mouse.y - graph.y(metres)) < reach)
            return frame;
    return std::nullopt;
}

// Drags a key: sideways to another frame, up and down to another distance. While it is held, the scale of the
// graph stays. True: a key is held.
bool drag_key(App& app, const Graph& graph) {
    static std::optional<int> held;
    const Timeline& line = app.state.timeline;
    if (ImGui::IsItemActivated()) held = key_under_pointer(line, graph);
    if (!ImGui::IsItemActive()) held.reset();
    if (!held || !line.keys.contains(*held)) return false;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::GetIO().MouseDelta.x == 0 && ImGui::GetIO().MouseDelta.y == 0) return true;
    const int to = nearest_frame(line, graph.frame(mouse.x));
    const bool is_taken = to != *held && line.keys.contains(to);
    const int frame = is_taken ? *held : to;
    say(app, "move_key " + std::to_string(*held) + " " + std::to_string(frame) + " " +
                 text_of(graph.metres(mouse.y), 5));
    held = frame;
    return true;
}

// Press or drag: that frame. With Shift: what is played; a click: all of it again.
void take_frame(App& app, int near) {
    static std::optional<int> range_from;
    const Timeline& line = app.state.timeline;
    if (ImGui::IsItemActivated()) range_from = ImGui::GetIO().KeyShift ? std::optional(near) : std::nullopt;
    if (!ImGui::IsItemActive()) return;
    if (!range_from) {
        if (near != line.frame) say(app, "frame " + std::to_string(near));
        return;
    }
    const bool all = *range_from == near;
    const int first = all ? line.frames.front() : std::min(*range_from, near);
    const int last = all ? line.frames.back() : std::max(*range_from, near);
    if (first != line.first || last != line.last)
        say(app, "range " + std::to_string(first) + " " + std::to_string(last));
}

// A tick for every frame, with numbers as close as they fit.
void draw_frames(const Timeline& line, const Graph& graph) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float low = graph.from.y + graph.size.y, high = low - ImGui::GetFontSize();
    float free = graph.from.x;
    for (const int frame : line.frames) {
        const float x = graph.x(frame);
        list->AddLine({x, high - 0.3f * ImGui::GetFontSize()}, {x, high}, IM_COL32(110, 110, 110, 255));
        const std::string number = std::to_string(frame);
        const float wide = ImGui::CalcTextSize(number.c_str()).x;
        const float left = std::clamp(x - 0.5f * wide, graph.from.x,
                                      std::max(graph.from.x, graph.from.x + graph.size.x - wide));
        if (left < free) continue;
        list->AddText({left, high}, IM_COL32(170, 170, 170, 255), number.c_str());
        free = left + wide + 1.5f * ImGui::GetFontSize();
    }
}

// The curve of the focus; keys are diamonds with their distances.
void draw_focus(const Timeline& line, const Graph& graph) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    std::vector<ImVec2> curve;
    constexpr double kMostDrawn = 20'000;
    if (graph.span < kMostDrawn)
        for (const auto& [frame, metres] : line.focus_over(line.frames.front(), line.frames.back()))
            curve.emplace_back(graph.x(frame), graph.y(metres));
    list->AddPolyline(curve.data(), int(curve.size()), IM_COL32(255, 220, 90, 255), 0, 1.5f);
    const float half = 0.3f * ImGui::GetFontSize();
    for (const auto& [frame, metres] : line.keys) {
        const ImVec2 p{graph.x(frame), graph.y(metres)};
        list->AddQuadFilled({p.x - half, p.y}, {p.x, p.y - half}, {p.x + half, p.y}, {p.x, p.y + half},
                            IM_COL32(255, 220, 90, 255));
        const std::string words = text_of(metres, 3) + " m";
        const float end = graph.from.x + graph.size.x - ImGui::CalcTextSize(words.c_str()).x;
        list->AddText({std::max(graph.from.x, std::min(p.x + 1.5f * half, end)), p.y - 2.5f * half},
                      IM_COL32(255, 220, 90, 200), words.c_str());
    }
}

}  // namespace

void draw_timeline(App& app) {
    const Timeline& line = app.state.timeline;
    draw_buttons(app);
    Graph graph;
    graph.from = ImGui::GetCursorScreenPos();
    graph.size = {std::max(1.0f, ImGui::GetContentRegionAvail().x),
                  std::max(1.0f, ImGui::GetContentRegionAvail().y)};
    graph.begin = line.frames.front();
    graph.span = std::max(1, line.frames.back() - line.frames.front());
    ImGui::InvisibleButton("frames", graph.size);
    is_field(app, "frames");
    static double most_dpt = 1e-6;  // stays while a key is dragged
    if (!ImGui::IsItemActive()) {
        most_dpt = 1e-6;
        for (const auto& [frame, metres] : line.keys) most_dpt = std::max(most_dpt, 1 / metres);
    }
    graph.most_dpt = most_dpt;
    if (key_under_pointer(line, graph) && ImGui::IsItemHovered())
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
    if (!drag_key(app, graph)) take_frame(app, nearest_frame(line, graph.frame(ImGui::GetIO().MousePos.x)));
    for (const auto& [frame, metres] : line.keys) {
        const int x = int(graph.x(frame)), y = int(graph.y(metres));
        app.widgets["key " + std::to_string(frame)] = {x - 1, y - 1, x + 1, y + 1};
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 from = graph.from, to{from.x + graph.size.x, from.y + graph.size.y};
    list->AddRectFilled(from, to, IM_COL32(25, 25, 25, 255));
    list->AddRectFilled({graph.x(line.first - 0.5), from.y}, {graph.x(line.last + 0.5), to.y},
                        IM_COL32(45, 45, 50, 255));
    draw_frames(line, graph);
    draw_focus(line, graph);
    list->AddLine({graph.x(line.frame), from.y}, {graph.x(line.frame), to.y}, IM_COL32(255, 255, 255, 255),
                  2);
}

}  // namespace petzval::view
