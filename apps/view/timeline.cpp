#include "timeline.h"

#include "app.h"
#include "commands.h"
#include "fields.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <imgui.h>
#include <iterator>

namespace petzval::view {

int Timeline::stepped(int by) const {
    if (frames.empty()) return frame;
    std::vector<int> played;
    for (const int f : frames)
        if (f >= first && f <= last) played.push_back(f);
    if (std::find(played.begin(), played.end(), frame) == played.end()) played = frames;
    const auto now = std::lower_bound(played.begin(), played.end(), frame);
    const auto count = std::ptrdiff_t(played.size());
    const std::ptrdiff_t to = ((now - played.begin()) % count + by % count + count) % count;
    return played[std::size_t(to)];
}

double Timeline::wanted_at(int at) const {
    const auto after = keys.lower_bound(at);
    if (after == keys.end()) return keys.rbegin()->second;
    if (after == keys.begin() || after->first == at) return after->second;
    const auto before = std::prev(after);
    double share = double(at - before->first) / double(after->first - before->first);
    if (easing) share = share * share * (3 - 2 * share);
    return 1 / ((1 - share) / before->second + share / after->second);
}

std::map<int, double> Timeline::focus_over(int from, int to) const {
    std::map<int, double> focus;
    if (keys.empty()) return focus;
    constexpr std::int64_t kMostFrames = 1'000'000;  // to look through for one
    if (focus_speed <= 0 || std::int64_t(to) - keys.begin()->first > kMostFrames) {
        for (int at = from; at <= to; ++at) focus[at] = wanted_at(at);
        return focus;
    }
    const int first_key = keys.begin()->first;
    double dioptres = 1 / keys.begin()->second;
    for (int at = std::min(from, first_key); at <= to; ++at) {
        if (at > first_key) dioptres += std::clamp(1 / wanted_at(at) - dioptres, -focus_speed, focus_speed);
        if (at >= from) focus[at] = 1 / dioptres;
    }
    return focus;
}

std::optional<double> Timeline::focus_at(int at) const {
    const std::map<int, double> focus = focus_over(at, at);
    return focus.empty() ? std::nullopt : std::optional(focus.begin()->second);
}

std::string Timeline::as_track() const {
    std::string text = "frame,focus\n";
    if (keys.empty()) return text;
    const int first_key = keys.begin()->first, last_key = keys.rbegin()->first;
    const int last_there = frames.empty() ? last_key : std::max(last_key, frames.back());
    const bool is_every = easing || focus_speed > 0;
    for (const auto& [at, metres] :
         is_every ? focus_over(first_key, focus_speed > 0 ? last_there : last_key) : keys)
        text += std::to_string(at) + "," + text_of(metres) + "\n";
    return text;
}

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
    button(line.playing ? "stop" : "play", "toggle shot.playing",
           "Shift-drag on the line below: what is played");
    button("set key", "key_focus");
    button("remove key", "remove_key");
    flowing_switch(app, "keys by clicks", "shot.keying");
    flowing_switch(app, "eased", "shot.easing");
    const float number = 4 * ImGui::GetFontSize();
    flow(number + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize("max. dioptres/frame").x);
    ImGui::SetNextItemWidth(number);
    number_widget(app, "shot.focus_speed", "max. dioptres/frame", 0.002, false);
    button("save track", "save_track track.csv", "track.csv, for defocus --track");
    button("load track", "load_track track.csv", "track.csv");
    if (!app.is_live()) return;
    flowing_switch(app, "record camera", "scene.recording");
    button("save path", "save_path path.csv", "where the camera went, path.csv");
    button("load path", "load_path path.csv", "path.csv");
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

}  // namespace

// Focus over frames, near up, in dioptres; keys are diamonds with their distances.
void draw_timeline(App& app) {
    const Timeline& line = app.state.timeline;
    draw_buttons(app);
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x),
                      std::max(1.0f, ImGui::GetContentRegionAvail().y)};
    ImGui::InvisibleButton("frames", size);
    is_field(app, "frames");
    const double begin = line.frames.front(), span = std::max(1, line.frames.back() - line.frames.front());
    const auto x_of = [&](double frame) {
        return from.x + float((frame - begin + 0.5) / (span + 1)) * size.x;
    };
    const double at =
        (double(ImGui::GetIO().MousePos.x - from.x) / double(size.x)) * (span + 1) + begin - 0.5;
    take_frame(app, *std::min_element(line.frames.begin(), line.frames.end(),
                                      [&](int a, int b) { return std::abs(a - at) < std::abs(b - at); }));
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(25, 25, 25, 255));
    list->AddRectFilled({x_of(line.first - 0.5), from.y}, {x_of(line.last + 0.5), from.y + size.y},
                        IM_COL32(45, 45, 50, 255));
    for (const int frame : line.frames)
        list->AddLine({x_of(frame), from.y + 0.85f * size.y}, {x_of(frame), from.y + size.y},
                      IM_COL32(110, 110, 110, 255));
    double most = 1e-6;
    for (const auto& [frame, metres] : line.keys) most = std::max(most, 1 / metres);
    const auto y_of = [&](double metres) { return from.y + size.y * float(0.8 - 0.65 / metres / most); };
    std::vector<ImVec2> curve;
    constexpr double kMostDrawn = 20'000;
    if (span < kMostDrawn)
        for (const auto& [frame, metres] : line.focus_over(line.frames.front(), line.frames.back()))
            curve.emplace_back(x_of(frame), y_of(metres));
    list->AddPolyline(curve.data(), int(curve.size()), IM_COL32(255, 220, 90, 255), 0, 1.5f);
    const float half = 0.3f * ImGui::GetFontSize();
    for (const auto& [frame, metres] : line.keys) {
        const ImVec2 p{x_of(frame), y_of(metres)};
        list->AddQuadFilled({p.x - half, p.y}, {p.x, p.y - half}, {p.x + half, p.y}, {p.x, p.y + half},
                            IM_COL32(255, 220, 90, 255));
        const std::string words = text_of(metres, 3) + " m";
        const float end = from.x + size.x - ImGui::CalcTextSize(words.c_str()).x;
        list->AddText({std::max(from.x, std::min(p.x, end)), p.y + half}, IM_COL32(255, 220, 90, 200),
                      words.c_str());
    }
    list->AddLine({x_of(line.frame), from.y}, {x_of(line.frame), from.y + size.y},
                  IM_COL32(255, 255, 255, 255), 2);
}

}  // namespace petzval::view
