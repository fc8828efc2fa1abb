#include "lens_panel.h"

#include "commands.h"
#include "fields.h"
#include "section_panel.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>

namespace petzval::view {
namespace {

constexpr ImU32 kLit = IM_COL32(255, 220, 90, 230);
constexpr ImU32 kLine = IM_COL32(150, 150, 150, 160);

Box box_of(const char* name, const ImVec2& size) {
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, {std::max(1.0f, size.x), std::max(1.0f, size.y)});
    const Box box{from, {from.x + size.x, from.y + size.y}};
    ImGui::GetWindowDrawList()->AddRectFilled(box.from, box.to, IM_COL32(12, 12, 12, 255));
    return box;
}

ImTextureID id_of(const Texture& texture) {
    return reinterpret_cast<ImTextureID>(std::uintptr_t(texture.name()));  // NOLINT: as the backend has it
}

// The disc fills the box, its middle in the middle; one of its pixels is `scale` wide.
float draw_disc(const Box& box, const Texture& texture, const LensCodes& codes) {
    if (texture.empty() || codes.width == 0) return 1;
    const float scale = std::min(
        {box.width() / float(codes.width), box.height() / float(codes.height), 2 * ImGui::GetFontSize()});
    const ImVec2 middle = box.middle();
    const ImVec2 half{0.5f * scale * float(codes.width), 0.5f * scale * float(codes.height)};
    ImGui::GetWindowDrawList()->AddImage(id_of(texture), {middle.x - half.x, middle.y - half.y},
                                         {middle.x + half.x, middle.y + half.y});
    return scale;
}

// Writes the first text that fits into the upper left corner; nothing if none fits.
void note_in(const Box& box, std::initializer_list<std::string> texts) {
    for (const std::string& text : texts) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        if (size.x + 8 > box.width() || size.y + 4 > 0.4f * box.height()) continue;
        ImDrawList* list = ImGui::GetWindowDrawList();
        list->AddRectFilled(box.from, {box.from.x + size.x + 8, box.from.y + size.y + 4},
                            IM_COL32(0, 0, 0, 150));
        list->AddText({box.from.x + 4, box.from.y + 2}, IM_COL32(235, 235, 235, 220), text.c_str());
        return;
    }
}

void picked_disc(App& app, float side) {
    const LensMade& made = app.lens_made();
    const Box box = box_of("disc", {side, side});
    is_field(app, "disc");
    // Size of a picture's pixel on the screen.
    const float scale = float(made.fine) * draw_disc(box, app.lens_pictures()[0], made.disc);
    if (app.state.pick)
        note_in(box, {"radius " + pixels_text(made.coc_px), pixels_text(made.coc_px)});
    else
        note_in(box, {"click the picture: its disc", "click the picture"});
    const ImVec2 middle = box.middle();
    if (scale > 6 && scale < box.width())  // the pixel itself
        ImGui::GetWindowDrawList()->AddRect({middle.x - 0.5f * scale, middle.y - 0.5f * scale},
                                            {middle.x + 0.5f * scale, middle.y + 0.5f * scale},
                                            IM_COL32(43, 143, 224, 255));
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsItemActive() && ImGui::IsMouseDown(0)) {
        const double x = double((mouse.x - middle.x) / scale), y = double((mouse.y - middle.y) / scale);
        static_cast<void>(act(app, "light " + text_of(x, 5) + " " + text_of(y, 5)));
    }
    if (app.state.lit)
        ImGui::GetWindowDrawList()->AddCircle(
            {middle.x + scale * float((*app.state.lit)[0]), middle.y + scale * float((*app.state.lit)[1])},
            0.3f * ImGui::GetFontSize(), kLit, 0, 2);
}

// On the axis, each with its radius in pixels.
void draw_strip(const App& app, const Box& box) {
    const LensCodes& strip = app.lens_made().strip;
    const float scale = draw_disc(box, app.lens_pictures()[3], strip);
    if (strip.width == 0) return;
    const float cell = scale * float(strip.width) / float(kStripDiscs);
    const float left = 0.5f * (box.from.x + box.to.x) - 0.5f * scale * float(strip.width);
    const int middle = kStripDiscs / 2;
    const int step = std::max(1, int(std::ceil(1.2f * ImGui::CalcTextSize("+60").x / std::max(1.0f, cell))));
    for (int i = middle % step; i < kStripDiscs; i += step) {
        const double radius = kStripReach_px * (2.0 * i / (kStripDiscs - 1) - 1);
        const std::string words = (radius > 0 ? "+" : "") + text_of(radius, 3);
        const ImVec2 size = ImGui::CalcTextSize(words.c_str());
        ImGui::GetWindowDrawList()->AddText({left + (float(i) + 0.5f) * cell - 0.5f * size.x, box.to.y},
                                            IM_COL32(200, 200, 200, 220), words.c_str());
    }
    ImGui::Dummy({1, ImGui::GetTextLineHeight()});
}

// Height of the curves, below their caption.
float curve_height(const Box& box) {
    return std::max(0.5f * box.height(), box.height() - 1.5f * ImGui::GetTextLineHeight());
}

// Dragged sideways, the curves bend where they are taken; with Shift the nearest wavelength alone.
void bend_curves(App& app, const Box& box, double most_mm) {
    static double zone = 0;
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActivated())
        zone = std::clamp(double((box.to.y - io.MousePos.y) / curve_height(box)), 0.0, 1.0);
    if (!ImGui::IsItemActive() || io.MouseDelta.x == 0) return;
    const double by_mm = double(io.MouseDelta.x / (0.45f * box.width())) * most_mm;
    static_cast<void>(
        act(app, "bend " + text_of(zone, 4) + " " + text_of(by_mm, 5) + (io.KeyShift ? " 549" : "")));
}

// Focus of the zones of the pupil, one curve a wavelength.
void draw_curves(App& app, const Box& box) {
    is_field(app, "curves",
             "drag sideways to bend the curves, with Shift only green; save_curves FILE saves the lens");
    const LongitudinalAberrationFacts& curves = app.lens_made().curves;
    double most = 1e-9;
    for (const auto& curve : curves.shift_mm)
        for (const double shift : curve)
            if (std::isfinite(shift)) most = std::max(most, std::abs(shift));
    bend_curves(app, box, std::max(most, 0.05));
    ImDrawList* list = ImGui::GetWindowDrawList();
    const float middle = 0.5f * (box.from.x + box.to.x);
    const float high = curve_height(box);
    list->AddLine({middle, box.from.y}, {middle, box.to.y}, kLine);
    if (curves.shift_mm.empty()) return note_in(box, {"no aberration", "none"});
    for (std::size_t w = 0; w < curves.shift_mm.size(); ++w) {
        const double um = curves.wavelengths_um[w];
        const ImU32 colour = um < 0.47   ? IM_COL32(110, 130, 255, 255)
                             : um < 0.52 ? IM_COL32(90, 200, 230, 255)
                             : um < 0.6  ? IM_COL32(150, 220, 90, 255)
                                         : IM_COL32(255, 110, 90, 255);
        std::vector<ImVec2> line;
        for (std::size_t z = 0; z < curves.zones.size(); ++z)
            if (std::isfinite(curves.shift_mm[w][z]))
                line.emplace_back(middle + float(0.45 * curves.shift_mm[w][z] / most) * box.width(),
                                  box.to.y - float(curves.zones[z]) * high);
        list->AddPolyline(line.data(), int(line.size()), colour, 0, 1.5f);
    }
    const std::string range = "± " + text_of(most, 2) + " mm";
    note_in(box, {"focus by zone, " + range, range});
}

// The lens parameters, to be dragged beside the discs. The ideal lens has no aberrations to vary.
void draw_numbers(App& app) {
    struct Number {
        const char *path, *label;
        float letters;
    };
    const bool is_ideal = app.state.choice.look.lens.name == "ideal";
    const bool has_own = !is_ideal && !app.lens_made().section.has_surfaces;
    const Number all[]{{"lens.blades", "blades", 3},
                       {has_own ? "lens.spherical" : "lens.added_spherical_waves", "spherical", 4},
                       {has_own ? "lens.axial_colour" : "lens.added_axial_colour_mm", "colour", 4},
                       {"lens.focus_shift_mm", "focus shift", 4},
                       {"lens.cats_eye", "cat's eye", 4},
                       {"lens.barrel", "barrel", 6},
                       {"lens.dust", "dust", 4}};
    const float letter = ImGui::GetFontSize();
    ImGui::PushID("numbers");
    for (const Number& number : all) {
        if (is_ideal && std::string(number.path) == "lens.focus_shift_mm") continue;
        const auto row = std::find_if(app.setup().fields.begin(), app.setup().fields.end(),
                                      [&](const FieldRow& r) { return r.path == number.path; });
        if (row == app.setup().fields.end()) continue;
        if (&number != all)
            flow(number.letters * letter + ImGui::CalcTextSize(number.label).x +
                 ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::SetNextItemWidth(number.letters * letter);
        const ImVec2 from = ImGui::GetCursorScreenPos();
        row_widget(app, *row, number.label);
        app.widgets[number.path] = {int(from.x), int(from.y), int(from.x + number.letters * letter),
                                    int(from.y + ImGui::GetFrameHeight())};  // without its label
    }
    ImGui::PopID();
}

}  // namespace

std::vector<std::size_t> lit_rays(const App& app) {
    std::vector<std::size_t> lit;
    if (!app.state.lit) return lit;
    const auto& rays = app.lens_made().section.rays;
    // A twelfth of the disc around the place.
    double reach = 0;
    for (const SectionRay& ray : rays) reach = std::max(reach, std::hypot(ray.disc_x_px, ray.disc_y_px));
    const double near = std::max(0.75, reach / 12);
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (std::hypot(rays[i].disc_x_px - (*app.state.lit)[0], rays[i].disc_y_px - (*app.state.lit)[1]) <
            near)
            lit.push_back(i);
    return lit;
}

void draw_lens(App& app) {
    const LensMade& made = app.lens_made();
    const ImVec2 all = ImGui::GetContentRegionAvail();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float strip = std::min(0.2f * all.y, all.x / float(kStripDiscs));
    const float top = ImGui::GetCursorPosY();
    const float letter = ImGui::GetFontSize();
    if (all.x > 32 * letter && all.y > 12 * letter) draw_numbers(app);  // else discs come first
    const float used = ImGui::GetCursorPosY() - top;
    const float high = std::max(8.0f, all.y - used - strip - 3.4f * ImGui::GetTextLineHeightWithSpacing());
    const float side = std::min(high, 0.3f * all.x), small = 0.5f * (high - gap);
    const Box section = box_of("section", {all.x - side - 2 * small - 3 * gap, high});
    draw_section(app, section);
    ImGui::SameLine();
    picked_disc(app, side);
    ImGui::SameLine();
    ImGui::BeginGroup();
    const Box front = box_of("front", {small, small});
    drag_blades(app, front, "in front");
    draw_disc(front, app.lens_pictures()[1], made.front);
    note_in(front, {"in front", "front"});
    const Box behind = box_of("behind", {small, small});
    drag_blades(app, behind, "behind");
    draw_disc(behind, app.lens_pictures()[2], made.behind);
    note_in(behind, {"behind"});
    ImGui::EndGroup();
    ImGui::SameLine();
    draw_curves(app, box_of("curves", {small, high}));
    draw_strip(app, box_of("strip", {all.x, strip}));
    ImGui::TextWrapped("%s", made.words.c_str());
}

}  // namespace petzval::view
