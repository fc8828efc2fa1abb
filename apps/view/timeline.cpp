#include "timeline.h"

#include "app.h"
#include "commands.h"
#include "fields.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
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

std::optional<double> Timeline::focus_at(int at) const {
    if (keys.empty()) return std::nullopt;
    const auto after = keys.lower_bound(at);
    if (after == keys.end()) return keys.rbegin()->second;
    if (after == keys.begin() || after->first == at) return after->second;
    const auto before = std::prev(after);
    double share = double(at - before->first) / double(after->first - before->first);
    if (easing) share = share * share * (3 - 2 * share);
    return 1 / ((1 - share) / before->second + share / after->second);
}

std::string Timeline::as_track() const {
    std::string text = "frame,focus\n";
    const auto line = [&](int at) { text += std::to_string(at) + "," + text_of(*focus_at(at)) + "\n"; };
    if (keys.empty()) return text;
    if (easing)
        for (int at = keys.begin()->first; at <= keys.rbegin()->first; ++at) line(at);
    else
        for (const auto& [at, metres] : keys) line(at);
    return text;
}

namespace {

void say(App& app, const std::string& line) { static_cast<void>(act(app, line)); }

void draw_buttons(App& app) {
    const Timeline& line = app.state.timeline;
    const auto button = [&](const char* label, const std::string& command) {
        if (ImGui::Button(label)) say(app, command);
        is_field(app, label);
        ImGui::SameLine();
    };
    button(line.playing ? "stop" : "play", "toggle shot.playing");
    button("set key", "key_focus");
    button("remove key", "remove_key");
    bool keying = line.keying, easing = line.easing;
    if (ImGui::Checkbox("keys by clicks", &keying)) say(app, "toggle shot.keying");
    is_field(app, "shot.keying");
    ImGui::SameLine();
    if (ImGui::Checkbox("eased", &easing)) say(app, "toggle shot.easing");
    is_field(app, "shot.easing");
    ImGui::SameLine();
    button("save track", "save_track track.csv");
    ImGui::Text("frame %d of %d … %d", line.frame, line.frames.front(), line.frames.back());
}

}  // namespace

// Focus over frames, near up, in dioptres; keys are diamonds. Press or drag: that frame.
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
    if (ImGui::IsItemActive()) {
        const double at =
            (double(ImGui::GetIO().MousePos.x - from.x) / double(size.x)) * (span + 1) + begin - 0.5;
        const int near = *std::min_element(line.frames.begin(), line.frames.end(),
                                           [&](int a, int b) { return std::abs(a - at) < std::abs(b - at); });
        if (near != line.frame) say(app, "frame " + std::to_string(near));
    }
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
    for (const int frame : line.frames)
        if (const auto metres = line.focus_at(frame)) curve.push_back({x_of(frame), y_of(*metres)});
    list->AddPolyline(curve.data(), int(curve.size()), IM_COL32(255, 220, 90, 255), 0, 1.5f);
    const float half = 0.3f * ImGui::GetFontSize();
    for (const auto& [frame, metres] : line.keys) {
        const ImVec2 p{x_of(frame), y_of(metres)};
        list->AddQuadFilled({p.x - half, p.y}, {p.x, p.y - half}, {p.x + half, p.y}, {p.x, p.y + half},
                            IM_COL32(255, 220, 90, 255));
    }
    list->AddLine({x_of(line.frame), from.y}, {x_of(line.frame), from.y + size.y},
                  IM_COL32(255, 255, 255, 255), 2);
}

}  // namespace petzval::view
