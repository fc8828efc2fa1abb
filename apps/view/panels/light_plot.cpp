// The histogram of the light that is shown, in the panel Display.
#include "fields.h"
#include "light_histogram.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <memory>

namespace petzval::view {
namespace {

std::shared_ptr<const Picture> light_shown(const App& app) {
    const std::string& shown = app.state.left.shown;
    if (shown == "sharp" && app.shot()) return {app.shot(), &app.shot()->shot.colour};
    return is_made(shown) ? app.side(0).whole : nullptr;
}

}  // namespace

void light_plot(App& app) {
    static std::shared_ptr<const Picture> seen;
    static LightHistogram histogram;
    const auto now = light_shown(app);
    if (now && now != seen && !now->empty()) {
        seen = now;
        histogram = histogram_of(*now);
    }
    if (!seen) return;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    const ImVec2 size{std::max(1.0f, ImGui::GetContentRegionAvail().x), 5 * ImGui::GetFontSize()};
    ImGui::InvisibleButton("light", size);
    is_field(app, "light histogram", "light of the shown picture, in stops; the line is 1 at this exposure");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(from, {from.x + size.x, from.y + size.y}, IM_COL32(25, 25, 25, 255));
    const ImU32 colours[]{IM_COL32(235, 80, 70, 150), IM_COL32(90, 200, 90, 150),
                          IM_COL32(90, 130, 255, 150)};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto& counts = histogram.counts[c];
        const float step = size.x / float(counts.size());
        for (std::size_t i = 0; i < counts.size(); ++i)
            list->AddRectFilled({from.x + float(i) * step, from.y + size.y * (1 - std::sqrt(counts[i]))},
                                {from.x + float(i + 1) * step, from.y + size.y}, colours[c]);
    }
    const double stops = -app.state.choice.develop.exposure_stops;
    const double share = (stops - LightHistogram::kLowest_stops) /
                         (LightHistogram::kHighest_stops - LightHistogram::kLowest_stops);
    const float x = from.x + float(std::clamp(share, 0.0, 1.0)) * size.x;
    list->AddLine({x, from.y}, {x, from.y + size.y}, IM_COL32(255, 255, 255, 200), 1.5f);
    ImGui::TextWrapped("-10 to +8 stops around 1; above 1: %.2g %%, black: %.2g %%",
                       100 * histogram.above_white, 100 * histogram.black);
}

}  // namespace petzval::view
