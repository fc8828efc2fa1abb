#include "petzval/defocus.h"
#include "petzval/develop.h"

#include "commands.h"
#include "fields.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

namespace petzval::view {
namespace {

constexpr ImU32 kNear = IM_COL32(43, 143, 224, 255), kFar = IM_COL32(243, 156, 18, 255);
constexpr ImU32 kSharp = IM_COL32(235, 235, 235, 255), kFocus = IM_COL32(255, 220, 90, 255);

struct Scale {
    const DepthHistogram& all;
    ImVec2 from, to;

    float x(double share) const { return from.x + float(share) * (to.x - from.x); }
    void line(double metres, ImU32 colour) const {
        const double share = all.share_of(metres);
        if (share >= 0 && share <= 1)
            ImGui::GetWindowDrawList()->AddLine({x(share), from.y}, {x(share), to.y}, colour, 1.5f);
    }
};

void draw_bars(const Scale& scale, const Result<FocusLimits>& limits) {
    const DepthHistogram& all = scale.all;
    const double steps = double(all.counts.size());
    const float high = scale.to.y - scale.from.y;
    for (std::size_t i = 0; i < all.counts.size(); ++i) {
        const double z = all.distance_at((double(i) + 0.5) / steps);
        const ImU32 colour = !limits || (z >= limits->near_m && z <= limits->far_m) ? kSharp
                             : z < limits->near_m                                   ? kNear
                                                                                    : kFar;
        ImGui::GetWindowDrawList()->AddRectFilled(
            {scale.x(double(i) / steps), scale.to.y - std::sqrt(all.counts[i]) * high},
            {scale.x(double(i + 1) / steps), scale.to.y}, colour);
    }
}

// 1, 2 and 5 times powers of ten, as many as there is room for.
void draw_ticks(const Scale& scale) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float tall = 0.3f * ImGui::GetFontSize();
    float free = scale.from.x;
    for (int power = -4; power < 7; ++power)
        for (const int step : {1, 2, 5}) {
            const double metres = step * std::pow(10.0, power), share = scale.all.share_of(metres);
            if (!(share >= 0 && share <= 1)) continue;
            const std::string words = text_of(metres, 3) + " m";
            const float x = scale.x(share), wide = ImGui::CalcTextSize(words.c_str()).x;
            const float left =
                std::clamp(x - 0.5f * wide, scale.from.x, std::max(scale.from.x, scale.to.x - wide));
            list->AddLine({x, scale.to.y}, {x, scale.to.y + tall}, IM_COL32(150, 150, 150, 255));
            if (left < free) continue;
            list->AddText({left, scale.to.y + tall}, IM_COL32(190, 190, 190, 255), words.c_str());
            free = left + wide + ImGui::GetFontSize();
        }
    ImGui::Dummy({1, tall + ImGui::GetTextLineHeight()});
}

void drag_focus(App& app, const Scale& scale) {
    if (!ImGui::IsItemActive()) return;
    const double share = double(ImGui::GetIO().MousePos.x - scale.from.x) / double(scale.to.x - scale.from.x);
    const std::string metres = text_of(scale.all.distance_at(std::clamp(share, 0.0, 1.0)), 5);
    if (const auto now = field_text(app, "focus"); !now || *now != metres)
        static_cast<void>(act(app, "set focus " + metres));
}

ImU32 display_colour(const Rgba& p) {
    const auto code = [&](float value) {
        const double light = p.a > 0 ? double(value / p.a) : 0;
        return int(std::lround(255 * srgb_encode(std::clamp(light, 0.0, 1.0))));
    };
    return IM_COL32(code(p.r), code(p.g), code(p.b), 255);
}

}  // namespace

void coverage_plot(App& app, const std::string& name, std::span<const DeepSample> samples) {
    DepthHistogram range;
    for (const DeepSample& sample : samples) {
        const double z = double(sample.depth);
        if (!(z > 0) || std::isinf(z)) continue;
        range.nearest_m = range.nearest_m > 0 ? std::min(range.nearest_m, z) : z;
        range.farthest_m = std::max(range.farthest_m, z);
    }
    if (!(range.farthest_m > 0)) return;
    range.nearest_m *= 0.9, range.farthest_m *= 1.2;  // room on both sides
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), 4 * ImGui::GetFontSize()};
    const Scale scale{range, from, {from.x + size.x, from.y + size.y}};
    ImGui::Dummy(size);
    is_field(app, "coverage " + name, "coverage from the front, by depth; each step is a sample");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(scale.from, scale.to, IM_COL32(25, 25, 25, 255));
    const auto x_of = [&](const DeepSample& sample) {
        const double z = double(sample.depth);
        return std::isinf(z) ? scale.to.x
                             : scale.x(std::clamp(range.share_of(std::max(z, range.nearest_m)), 0.0, 1.0));
    };
    float covered = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        covered += (1 - covered) * samples[i].colour.a;
        const float left = x_of(samples[i]),
                    right = i + 1 < samples.size() ? x_of(samples[i + 1]) : scale.to.x;
        const float top = scale.to.y - covered * size.y;
        list->AddRectFilled({left, top}, {right, scale.to.y}, display_colour(samples[i].colour));
        list->AddLine({left, scale.to.y}, {left, top}, kFocus, 1.5f);
        list->AddLine({left, top}, {right, top}, kFocus, 1.5f);
    }
    draw_ticks(scale);
}

// Histogram of the picture's depth; the sharp part is white. Drag to focus.
void depth_panel(App& app) {
    const DepthHistogram& all = app.shot()->histogram;
    if (all.counts.empty()) return ImGui::TextWrapped("no depth in metres");
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), 5 * ImGui::GetFontSize()};
    const Scale scale{all, from, {from.x + size.x, from.y + size.y}};
    ImGui::InvisibleButton("depth", size);
    is_field(app, "depth histogram");
    const auto camera = app.camera();
    const auto limits = camera ? focus_limits(*camera, app.shot()->shot.place.display_window.width(),
                                              app.setup().run.permissible_radius_px)
                               : Result<FocusLimits>(camera.error());
    drag_focus(app, scale);
    ImGui::GetWindowDrawList()->AddRectFilled(scale.from, scale.to, IM_COL32(25, 25, 25, 255));
    draw_bars(scale, limits);
    if (limits) {
        scale.line(limits->near_m, kNear), scale.line(limits->far_m, kFar);
        scale.line(camera->focus_distance_m, kFocus);
    }
    draw_ticks(scale);
    ImGui::Text("%.4g m … %.4g m%s", all.nearest_m, all.farthest_m, all.has_misses ? ", and beyond" : "");
    if (limits)
        ImGui::TextWrapped(
            "sharp (radius under %.3g px): %.4g m to %s; hyperfocal %.4g m",
            app.setup().run.permissible_radius_px, limits->near_m,
            std::isinf(limits->far_m) ? "infinity" : (text_of(limits->far_m, 4) + " m").c_str(),
            limits->hyperfocal_m);
}

}  // namespace petzval::view
