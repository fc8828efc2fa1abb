#include "canvas.h"

#include "commands.h"
#include "fields.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

namespace petzval::view {
namespace {

ImVec2 at(const Mapping& m, double x, double y) { return {float(m.screen_x(x)), float(m.screen_y(y))}; }

Mapping mapping_of(const App& app, const ImVec2& min, const ImVec2& size) {
    Mapping m;
    m.x0 = double(min.x), m.y0 = double(min.y), m.width = double(size.x), m.height = double(size.y);
    const Rect frame = app.frame();
    const double aspect = app.pixel_aspect();
    const State& state = app.state;
    if (frame.empty()) return m;
    const bool fits = state.zoom <= 0;
    const double zoom =
        fits ? std::min(m.width / (frame.width() * aspect), m.height / frame.height()) : state.zoom;
    m.scale_x = zoom * aspect, m.scale_y = zoom;
    m.centre_x = fits ? 0.5 * (frame.x0 + frame.x1) : state.centre_x;
    m.centre_y = fits ? 0.5 * (frame.y0 + frame.y1) : state.centre_y;
    return m;
}

void draw_shown(const Mapping& m, const Shown& shown, ImU32 tint) {
    const Negative& of = shown.print.of;
    if (shown.texture.empty() || (!of.picture && !of.codes && !of.plane)) return;
    // Twice the size and more shows pixels as squares; less is smoothed.
    shown.texture.enlarge_smoothly(m.scale_y < 2 && m.scale_y != 1);
    // The last block of a reduced picture may reach beyond the part.
    const ImVec2 from = at(m, of.part.x0, of.part.y0);
    const ImVec2 to =
        at(m, of.part.x0 + shown.print.width * of.reduce, of.part.y0 + shown.print.height * of.reduce);
    ImGui::GetWindowDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(std::uintptr_t(shown.texture.name())),  // NOLINT: as the backend has it
        from, to, {0, 0}, {1, 1}, tint);
}

// All of a side, dimmed where only its detail is of the present look.
void draw_side(const App& app, int index) {
    const SideFrames& frames = app.side(index);
    const bool dim = frames.whole_is_old && frames.wish && frames.wish->region;
    draw_shown(app.mapping, app.on_screen()[std::size_t(2 * index)],
               dim ? IM_COL32(110, 110, 110, 255) : IM_COL32_WHITE);
    draw_shown(app.mapping, app.on_screen()[std::size_t(2 * index + 1)], IM_COL32_WHITE);
}

void draw_label(const ImVec2& where, const std::string& text, bool to_the_left = false) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = 0.3f * ImGui::GetFontSize();
    const ImVec2 from{where.x - (to_the_left ? size.x : 0), where.y};
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled({from.x - pad, from.y - pad}, {from.x + size.x + pad, from.y + size.y + pad},
                        IM_COL32(0, 0, 0, 170), pad);
    list->AddText(from, IM_COL32(235, 235, 235, 255), text.c_str());
}

std::string radius_at_pick(const App& app) {
    const auto radius = app.radius_at(*app.state.pick);
    return radius ? ", radius " + pixels_text(double(*radius)) : "";
}

void draw_pick(const App& app) {
    if (!app.state.pick || is_buffer(app.state.left.shown)) return;
    const Rect frame = app.frame();
    const ImVec2 p = at(app.mapping, frame.x0 + app.state.pick->x + 0.5, frame.y0 + app.state.pick->y + 0.5);
    const float arm = 0.5f * ImGui::GetFontSize();
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (const auto& [width, colour] :
         {std::pair(3.0f, IM_COL32(0, 0, 0, 200)), std::pair(1.0f, IM_COL32(255, 220, 90, 255))})
        for (const float sign : {-1.0f, 1.0f}) {
            list->AddLine({p.x + sign * 0.4f * arm, p.y}, {p.x + sign * 1.4f * arm, p.y}, colour, width);
            list->AddLine({p.x, p.y + sign * 0.4f * arm}, {p.x, p.y + sign * 1.4f * arm}, colour, width);
        }
    const auto depth = app.depth_near(*app.state.pick);
    if (!depth) return;
    const std::string words = text_of(*depth, 4) + " m" + radius_at_pick(app);
    // Left of it and above where it would be cut off.
    const ImVec2 size = ImGui::CalcTextSize(words.c_str()), end = list->GetClipRectMax();
    const bool is_left = p.x + 3 * arm + size.x > end.x, is_above = p.y + 2 * arm + size.y > end.y;
    draw_label({p.x + (is_left ? -2 : 2) * arm, p.y + (is_above ? -arm - size.y : arm)}, words, is_left);
}

void draw_legend(const App& app) {
    if (!app.state.overlay && app.state.left.shown != "coc") return;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float x = float(app.mapping.x0) + line,
                bottom = float(app.mapping.y0 + app.mapping.height) - 4.6f * line;
    const struct {
        ImU32 colour;
        std::string text;
    } entries[] = {{IM_COL32(43, 143, 224, 255), "near"},
                   {app.state.overlay ? IM_COL32(255, 255, 255, 255) : IM_COL32(0, 0, 0, 255),
                    "in focus: radius under " + text_of(app.setup().run.permissible_radius_px, 3) + " px"},
                   {IM_COL32(243, 156, 18, 255), "far"}};
    float y = bottom;
    for (const auto& entry : entries) {
        draw_label({x + line, y}, entry.text);
        const ImVec2 corner{x + 0.7f * line, y + 0.7f * line};
        ImGui::GetWindowDrawList()->AddRectFilled({x, y}, corner, entry.colour);
        ImGui::GetWindowDrawList()->AddRect({x, y}, corner, IM_COL32(130, 130, 130, 255));
        y += 1.2f * line;
    }
}

void draw_buffer_names(const App& app) {
    if (!is_buffer(app.state.left.shown) || !app.side(0).panels) return;
    for (const Panel& panel : *app.side(0).panels) {
        // Its parts, between two spaces, as far as they fit.
        std::string name = panel.name;
        const double wide = panel.area.width() * app.mapping.scale_x - double(ImGui::GetFontSize());
        for (std::size_t end = name.rfind("  ");
             end != std::string::npos && double(ImGui::CalcTextSize(name.c_str()).x) > wide;
             end = name.rfind("  "))
            name.resize(end);
        draw_label(at(app.mapping, panel.area.x0 + 4, panel.area.y0 + 4), name);
    }
}

// The line of the wipe can be taken anywhere near it.
bool drag_wipe(App& app) {
    static bool dragging = false;
    if (!app.state.wiping) return dragging = false;
    const Mapping& m = app.mapping;
    const double x = m.x0 + app.state.wipe * m.width;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool near = std::abs(double(mouse.x) - x) < 0.6 * double(ImGui::GetFontSize());
    if (ImGui::IsItemHovered() && near) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemHovered() && near && ImGui::IsMouseClicked(0)) dragging = true;
    if (!ImGui::IsMouseDown(0)) dragging = false;
    if (dragging)
        static_cast<void>(act(
            app, "set view.wipe " + text_of(std::clamp((double(mouse.x) - m.x0) / m.width, 0.0, 1.0), 6)));
    return dragging;
}

std::string pixel_words(const App& app, const ImVec2& p) {
    const Rect frame = app.frame();
    return text_of(std::floor(app.mapping.frame_x(double(p.x))) - frame.x0) + " " +
           text_of(std::floor(app.mapping.frame_y(double(p.y))) - frame.y0);
}

// In a scene a drag turns the camera, a click focuses.
void turn_camera(App& app, bool is_wipe) {
    const ImGuiIO& io = ImGui::GetIO();
    if (is_wipe) return;
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, 4) &&
        (io.MouseDelta.x != 0 || io.MouseDelta.y != 0))
        static_cast<void>(act(app, "orbit " + text_of(-0.4 * double(io.MouseDelta.x), 6) + " " +
                                       text_of(0.4 * double(io.MouseDelta.y), 6)));
    if (ImGui::IsMouseReleased(0) && ImGui::IsItemHovered() && io.MouseDragMaxDistanceSqr[0] < 16)
        static_cast<void>(act(app, "focus " + pixel_words(app, io.MousePos)));
}

// Left: focus; right: look at; middle or space and left: move; wheel: zoom about the pointer.
void take_mouse(App& app) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool moving = ImGui::IsMouseDragging(2, 0) || (ImGui::IsMouseDragging(1, 4));
    static bool is_wipe = false;
    if (ImGui::IsMouseClicked(0) || !ImGui::IsMouseDown(0)) is_wipe = false;
    is_wipe = drag_wipe(app) || is_wipe;
    if (!ImGui::IsItemHovered() && !ImGui::IsItemActive()) return;
    if (moving && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0))
        static_cast<void>(act(app, "pan " + text_of(double(io.MouseDelta.x) / app.mapping.scale_x) + " " +
                                       text_of(double(io.MouseDelta.y) / app.mapping.scale_y)));
    if (io.MouseWheel != 0 && ImGui::IsItemHovered())
        static_cast<void>(
            act(app, "zoom " +
                         text_of(std::clamp(app.mapping.scale_y * std::pow(1.25, double(io.MouseWheel)), 0.02,
                                            256.0)) +
                         " " + pixel_words(app, io.MousePos)));
    if (app.is_live()) return turn_camera(app, is_wipe);
    // Held down, the focus follows the pointer.
    const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
    if (!is_wipe && ImGui::IsItemActive() && ImGui::IsMouseDown(0) && (ImGui::IsMouseClicked(0) || moved))
        static_cast<void>(act(app, "focus " + pixel_words(app, io.MousePos)));
    if (ImGui::IsMouseReleased(1) && ImGui::IsItemHovered() && io.MouseDragMaxDistanceSqr[1] < 16)
        static_cast<void>(act(app, "pick " + pixel_words(app, io.MousePos)));
}

// In the middle of an empty window: what is waited for, or what is wrong.
void draw_empty(const App& app, const ImVec2& min, const ImVec2& size) {
    const std::string words = !app.trouble.empty() ? plain_words(app, app.trouble) : app.waits_for();
    const float wide = std::max(1.0f, 0.8f * size.x);
    const ImVec2 text = ImGui::CalcTextSize(words.c_str(), nullptr, false, wide);
    ImGui::GetWindowDrawList()->AddText(
        ImGui::GetFont(), ImGui::GetFontSize(),
        {min.x + 0.5f * (size.x - text.x), min.y + 0.5f * (size.y - text.y)},
        app.trouble.empty() ? IM_COL32(170, 170, 170, 255) : IM_COL32(255, 115, 90, 255), words.c_str(),
        nullptr, wide);
}

}  // namespace

std::string name_of_side(const App& app, const Side& side) {
    if (side.shown != "result") return side.shown;
    if (side.on_cpu) return "cpu";
    return side.engine.empty() ? app.state.choice.look.engine : side.engine;
}

void draw_canvas(App& app) {
    const ImVec2 min = ImGui::GetCursorScreenPos();
    ImVec2 size = ImGui::GetContentRegionAvail();
    size = {std::max(size.x, 1.0f), std::max(size.y, 1.0f)};
    app.mapping = mapping_of(app, min, size);
    ImGui::InvisibleButton("canvas", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    if (!app.shot()) return draw_empty(app, min, size);
    take_mouse(app);
    app.mapping = mapping_of(app, min, size);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 max{min.x + size.x, min.y + size.y};
    list->PushClipRect(min, max, true);
    draw_side(app, 0);
    const float split = min.x + float(app.state.wipe) * size.x;
    if (app.state.wiping) {
        list->PushClipRect({split, min.y}, max, true);
        list->AddRectFilled({split, min.y}, max, IM_COL32(20, 20, 20, 255));
        draw_side(app, 1);
        list->PopClipRect();
    }
    if (app.state.overlay) draw_shown(app.mapping, app.on_screen()[4], IM_COL32_WHITE);
    if (app.state.wiping) {
        list->AddLine({split, min.y}, {split, max.y}, IM_COL32(255, 220, 90, 255), 2);
        const float pad = 0.6f * ImGui::GetFontSize();
        draw_label({split - pad, min.y + pad}, name_of_side(app, app.state.left), true);
        draw_label({split + pad, min.y + pad}, name_of_side(app, app.state.right));
    }
    draw_buffer_names(app);
    draw_legend(app);
    draw_pick(app);
    list->PopClipRect();
}

}  // namespace petzval::view
