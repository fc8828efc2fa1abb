#include "widgets.h"

#include "commands.h"
#include "fields.h"
#include "ranges.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <imgui.h>
#include <map>
#include <sstream>
#include <vector>

namespace petzval::view {
namespace {

void say(App& app, const std::string& path, const std::string& value) {
    static_cast<void>(act(app, "set " + path + " \"" + value + "\""));
}

std::vector<std::string> choices_of(const std::string& placeholder) {
    std::vector<std::string> words;
    std::istringstream in(placeholder);
    for (std::string word; std::getline(in, word, '|');) words.push_back(word);
    return words;
}

// Until its end, what is drawn is bold if the field differs from its default.
class Marked {
public:
    Marked(const App& app, const std::string& path) : is_on_(is_changed(app, path)) {
        const auto& fonts = ImGui::GetIO().Fonts->Fonts;
        if (is_on_) ImGui::PushFont(fonts[fonts.Size - 1]);
    }
    ~Marked() {
        if (is_on_) ImGui::PopFont();
    }
    Marked(const Marked&) = delete;
    Marked& operator=(const Marked&) = delete;

private:
    bool is_on_;
};

// Why the value cannot be used here; empty: it can.
std::string why_not(const App& app, const FieldRow& row, const std::string& word) {
    const bool is_of_gpu = row.path == "engine" && word == "realtime";
    return is_of_gpu && !app.setup().cpu_session ? "needs a GPU: start the window with --device gpu" : "";
}

void choice_widget(App& app, const FieldRow& row, const std::string& label, const std::string& now) {
    if (ImGui::BeginCombo(label.c_str(), now.c_str())) {
        for (const std::string& word : choices_of(row.placeholder)) {
            const std::string why = why_not(app, row, word);
            const auto flags = why.empty() ? ImGuiSelectableFlags_None : ImGuiSelectableFlags_Disabled;
            if (ImGui::Selectable(word.c_str(), word == now, flags)) say(app, row.path, word);
            if (!why.empty()) is_field(app, row.path + " " + word, why);
        }
        ImGui::EndCombo();
    }
    is_field(app, row.path, row.help);
}

// Text that is taken when the pointer or Enter leaves it.
void text_widget(App& app, const FieldRow& row, const std::string& label, const std::string& now) {
    char text[512] = {};
    std::strncpy(text, now.c_str(), sizeof text - 1);
    ImGui::InputTextWithHint(label.c_str(), row.placeholder.c_str(), text, sizeof text);
    is_field(app, row.path, row.help);
    if (ImGui::IsItemDeactivatedAfterEdit()) say(app, row.path, text);
}

struct NumberNow {
    double value = 0;
    bool is_known = false;
    std::string text;  // "file", "unknown", "?"
};

NumberNow number_now(const App& app, const std::string& path) {
    const auto text = field_text(app, path);
    const auto number = text ? number_of(*text) : Result<double>(text.error());
    return {number ? *number : 0, bool(number), text ? *text : "?"};
}

// A slider where the field has usual ends and there is room for it, else a number to drag.
void look_number(App& app, const FieldRow& row, const std::string& label, double now, bool has_room) {
    double value = now;
    const bool whole = row.placeholder == "N" && value == std::round(value);
    const auto ends = has_room || row.placeholder == "FRACTION" ? usual_ends(row) : std::nullopt;
    const std::string format = ends ? ends->format : number_format(row.placeholder, whole);
    const bool changed =
        ends ? ImGui::SliderScalar(label.c_str(), ImGuiDataType_Double, &value, &ends->least, &ends->most,
                                   format.c_str(), ends->is_scale ? ImGuiSliderFlags_Logarithmic : 0)
             : ImGui::DragScalar(label.c_str(), ImGuiDataType_Double, &value, whole ? 0.05f : 0.005f, nullptr,
                                 nullptr, format.c_str());
    is_field(app, row.path, row.help);
    if (!changed || !std::isfinite(value)) return;
    const double wanted = whole ? std::round(value) : value;
    // Numbers of blades between 0 and 3 are invalid.
    const double fitting = row.path == "lens.blades" && wanted > 0 && wanted < 3 ? (now > 0 ? 0 : 3) : wanted;
    if (fitting != now) say(app, row.path, text_of(fitting, 6));
}

void say_number(App& app, const std::string& path, bool changed, double value, const std::string& help = "") {
    is_field(app, path, help);
    if (changed && std::isfinite(value)) say(app, path, text_of(value, 6));
}

}  // namespace

void is_field(App& app, const std::string& path, const std::string& help) {
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    app.widgets[path] = {int(from.x), int(from.y), int(to.x), int(to.y)};
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right) && is_changed(app, path))
        static_cast<void>(act(app, "reset " + path));
    if (help.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
    ImGui::TextUnformatted((help + "\n" + path).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void number_widget(App& app, const std::string& path, const std::string& label, double speed, bool is_scale) {
    NumberNow now = number_now(app, path);
    const Marked marked(app, path);
    const double step = is_scale ? std::max(std::abs(now.value), 1e-3) * 0.005 : speed;
    const bool changed = ImGui::DragScalar(label.c_str(), ImGuiDataType_Double, &now.value, float(step),
                                           nullptr, nullptr, now.is_known ? "%.5g" : now.text.c_str());
    say_number(app, path, changed, now.value);
}

void slider_widget(App& app, const std::string& path, const std::string& label, const Ends& ends,
                   const std::string& help) {
    NumberNow now = number_now(app, path);
    if (!now.is_known) now.value = ends.least;
    const Marked marked(app, path);
    const bool changed =
        ImGui::SliderScalar(label.c_str(), ImGuiDataType_Double, &now.value, &ends.least, &ends.most,
                            now.is_known ? ends.format : "auto",
                            ends.is_scale ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
    say_number(app, path, changed, now.value, help);
}

void flow(float width) {
    const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width;
    if (end < ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x) ImGui::SameLine();
}

bool flowing_button(const char* label) {
    flow(ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x);
    return ImGui::Button(label);
}

void switch_widget(App& app, const std::string& path, const std::string& label) {
    const auto now = field_text(app, path);
    bool on = now && (*now == "on" || *now == "true");
    if (ImGui::Checkbox(label.c_str(), &on)) static_cast<void>(act(app, "toggle " + path));
    is_field(app, path);
}

void row_widget(App& app, const FieldRow& row, const std::string& called) {
    const auto now = field_text(app, row.path);
    if (!now) return;
    const std::string label = called.empty() ? label_of(row) : called;
    const Marked marked(app, row.path);
    if (row.placeholder.empty() || row.placeholder == "off|on") {
        bool on = *now == "true" || *now == "on";
        const char* words[] = {row.placeholder.empty() ? "false" : "off",
                               row.placeholder.empty() ? "true" : "on"};
        if (ImGui::Checkbox(label.c_str(), &on)) say(app, row.path, words[on ? 1 : 0]);
        return is_field(app, row.path, row.help);
    }
    if (row.placeholder.find('|') != std::string::npos) return choice_widget(app, row, label, *now);
    const auto number = number_of(*now);
    if (!number || !std::isfinite(*number)) return text_widget(app, row, label, *now);
    look_number(app, row, label, *number, called.empty());
}

}  // namespace petzval::view
