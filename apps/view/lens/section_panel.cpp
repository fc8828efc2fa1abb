#include "section_panel.h"

#include "commands.h"
#include "fields.h"
#include "lens_panel.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace petzval::view {
namespace {

constexpr ImU32 kGlass = IM_COL32(70, 110, 140, 90), kFlint = IM_COL32(90, 100, 140, 130);
constexpr ImU32 kRay = IM_COL32(150, 190, 120, 110), kLit = IM_COL32(255, 220, 90, 230);
constexpr ImU32 kLine = IM_COL32(150, 150, 150, 160), kHandle = IM_COL32(235, 235, 235, 255);
constexpr ImU32 kRim = IM_COL32(230, 150, 90, 255);

// Mapping from millimetres to the screen: the whole section, same scale in both directions.
struct SectionFrame {
    double scale = 1, left = 0, middle = 0, z0 = 0;

    SectionFrame(const LensMade& made, const Box& box) {
        const LensSection& section = made.section;
        double first = 0, tallest = std::max(1.0, section.stop_radius_mm);
        for (const BarrelRim& rim : made.of.choice.barrel) {
            tallest = std::max(tallest, std::min(rim.radius_mm, 3 * section.stop_radius_mm));
            first = std::min(first, made.pupil_z_mm - rim.distance_mm);
        }
        for (const SectionGlass& glass : section.glass)
            for (const SectionPoint& p : glass.outline) tallest = std::max(tallest, std::abs(p.y_mm));
        for (const SectionRay& ray : section.rays) first = std::min(first, ray.path.front().z_mm);
        tallest = std::max(tallest, std::abs(section.image_y_mm));
        const double length = std::max(1.0, section.sensor_z_mm - first);
        scale = std::min(0.94 * double(box.width()) / length, 0.44 * double(box.height()) / tallest);
        z0 = first + 0.5 * length;
        left = double(box.from.x) + 0.5 * double(box.width()),
        middle = double(box.from.y) + 0.5 * double(box.height());
    }
    ImVec2 operator()(const SectionPoint& p) const {
        return {float(left + (p.z_mm - z0) * scale), float(middle - p.y_mm * scale)};
    }
};

void draw_path(const SectionFrame& at, const SectionRay& ray, ImU32 colour, float width) {
    std::vector<ImVec2> line;
    for (const SectionPoint& p : ray.path) line.push_back(at(p));
    ImGui::GetWindowDrawList()->AddPolyline(line.data(), int(line.size()), colour, 0, width);
}

void draw_glass(const SectionFrame& at, const LensSection& section) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (const SectionGlass& glass : section.glass) {
        std::vector<ImVec2> outline;
        for (const SectionPoint& p : glass.outline) outline.push_back(at(p));
        // Not convex: two halves of slices from front to back are.
        const std::size_t half = outline.size() / 2;
        for (std::size_t i = 0; i + 1 < half; ++i)
            list->AddQuadFilled(outline[i], outline[i + 1], outline[outline.size() - 2 - i],
                                outline[outline.size() - 1 - i], glass.is_flint ? kFlint : kGlass);
        list->AddPolyline(outline.data(), int(outline.size()), kLine, ImDrawFlags_Closed, 1);
    }
}

// Parts that can be dragged.
enum class Part { None, Stop, Sensor, Rim };

// The dragged part in its initial state: the drawing follows the drag, a step behind.
struct Grab {
    Part part = Part::None;
    std::size_t rim = 0;
    double below = 1;  // the axis: +1, above: -1
    double scale = 1, stop_radius_mm = 1, f_number = 0, shift_mm = 0;
    std::vector<BarrelRim> barrel;
    double dx = 0, dy = 0;  // screen pixels since
};

float reach() { return 0.6f * ImGui::GetFontSize(); }

Grab grabbed_at(const App& app, const SectionFrame& at, const ImVec2& mouse) {
    const LensMade& made = app.lens_made();
    const LensSection& section = made.section;
    Grab grab;
    grab.below = double(mouse.y) > at.middle ? 1 : -1;
    grab.scale = at.scale, grab.stop_radius_mm = section.stop_radius_mm;
    grab.f_number = made.of.mount.camera.f_number;
    const LensChoice& lens = app.state.choice.look.lens;
    grab.shift_mm = lens.focus_mode == FocusMode::Shift  ? lens.focus_shift_mm
                    : lens.focus_mode == FocusMode::Best ? made.best_focus_mm
                                                         : 0;
    grab.barrel = made.of.choice.barrel;
    const double height_mm = std::abs(double(mouse.y) - at.middle) / at.scale,
                 near_mm = double(reach()) / at.scale;
    const auto is_near = [&](double z_mm, double from_mm) {
        return std::abs(at({z_mm, 0}).x - mouse.x) < reach() && height_mm > from_mm - near_mm;
    };
    for (std::size_t i = 0; i < grab.barrel.size(); ++i)
        if (is_near(made.pupil_z_mm - grab.barrel[i].distance_mm, grab.barrel[i].radius_mm))
            grab.part = Part::Rim, grab.rim = i;
    // The sensor of a perfect lens stands in its focus.
    if (lens.name != "ideal" && is_near(section.sensor_z_mm, 0)) grab.part = Part::Sensor;
    if (is_near(section.stop_z_mm, section.stop_radius_mm)) grab.part = Part::Stop;
    return grab;
}

const char* help_for(Part part) {
    switch (part) {
        case Part::Stop:
            return "the stop: drag up or down to change the f-number";
        case Part::Sensor:
            return "the sensor: drag sideways; a pixel is 0.01 mm of focus shift";
        case Part::Rim:
            return "a rim of the barrel: drag its edge, or drag the rim along the axis";
        case Part::None:
            break;
    }
    return nullptr;
}

void drag_stop(App& app, const Grab& grab) {
    const double radius_mm = grab.stop_radius_mm + grab.below * grab.dy / grab.scale;
    const double f_number =
        grab.f_number * grab.stop_radius_mm / std::max(radius_mm, 0.02 * grab.stop_radius_mm);
    static_cast<void>(act(
        app, "set fstop " + text_of(std::clamp(f_number, std::max(app.lens_made().opens_to, 0.1), 64.0), 9)));
}

void drag_sensor(App& app, const Grab& grab) {
    constexpr double kShift_mm = 0.01;  // a pixel of the screen
    static_cast<void>(act(app, "set lens.focus_shift_mm " + text_of(grab.shift_mm + kShift_mm * grab.dx, 6)));
}

void drag_rim(App& app, const Grab& grab) {
    std::string text;
    for (std::size_t i = 0; i < grab.barrel.size(); ++i) {
        BarrelRim rim = grab.barrel[i];
        if (i == grab.rim) {
            rim.radius_mm = std::max(0.1, rim.radius_mm + grab.below * grab.dy / grab.scale);
            rim.distance_mm -= grab.dx / grab.scale;
        }
        text += (text.empty() ? "" : ";") + text_of(rim.radius_mm, 5) + "," + text_of(rim.distance_mm, 5);
    }
    static_cast<void>(act(app, "set lens.barrel \"" + text + "\""));
}

void drag_parts(App& app, const SectionFrame& at) {
    static Grab grab;
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActivated()) grab = grabbed_at(app, at, io.MousePos);
    const Part under = ImGui::IsItemActive()    ? grab.part
                       : ImGui::IsItemHovered() ? grabbed_at(app, at, io.MousePos).part
                                                : Part::None;
    if (const char* help = help_for(under)) {
        ImGui::SetMouseCursor(under == Part::Stop     ? ImGuiMouseCursor_ResizeNS
                              : under == Part::Sensor ? ImGuiMouseCursor_ResizeEW
                                                      : ImGuiMouseCursor_ResizeAll);
        if (!ImGui::IsItemActive()) ImGui::SetTooltip("%s", help);
    }
    if (!ImGui::IsItemActive() || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return;
    grab.dx += double(io.MouseDelta.x), grab.dy += double(io.MouseDelta.y);
    if (grab.part == Part::Stop) drag_stop(app, grab);
    if (grab.part == Part::Sensor) drag_sensor(app, grab);
    if (grab.part == Part::Rim) drag_rim(app, grab);
}

// A bar from a height outward, above and below the axis; the end below is a widget of that name.
void draw_edges(App& app, const SectionFrame& at, const std::string& name, double z_mm, double height_mm,
                ImU32 colour) {
    const double outer_mm = height_mm + 0.35 * app.lens_made().section.stop_radius_mm;
    for (const double side : {-1.0, 1.0}) {
        const ImVec2 edge = at({z_mm, side * height_mm});
        ImGui::GetWindowDrawList()->AddLine(edge, at({z_mm, side * outer_mm}), colour, 2);
        ImGui::GetWindowDrawList()->AddCircleFilled(edge, 0.2f * ImGui::GetFontSize(), colour);
        app.widgets[name] = {int(edge.x) - 1, int(edge.y) - 1, int(edge.x) + 2, int(edge.y) + 2};
    }
}

void draw_parts(App& app, const SectionFrame& at) {
    const LensMade& made = app.lens_made();
    const LensSection& section = made.section;
    draw_edges(app, at, "stop", section.stop_z_mm, section.stop_radius_mm, kHandle);
    const auto& barrel = made.of.choice.barrel;
    for (std::size_t i = 0; i < barrel.size(); ++i)
        draw_edges(app, at, "rim " + std::to_string(i + 1), made.pupil_z_mm - barrel[i].distance_mm,
                   barrel[i].radius_mm, kRim);
    const double half = std::max(std::abs(section.image_y_mm) * 1.1, 2.0);
    const ImVec2 top = at({section.sensor_z_mm, half}), bottom = at({section.sensor_z_mm, -half});
    ImGui::GetWindowDrawList()->AddLine(bottom, top, kHandle, 2);
    app.widgets["sensor"] = {int(top.x) - 1, int(top.y), int(top.x) + 2, int(bottom.y)};
    if (!section.has_surfaces)
        ImGui::GetWindowDrawList()->AddLine(at({0, -section.stop_radius_mm}), at({0, section.stop_radius_mm}),
                                            IM_COL32(120, 170, 210, 200), 3);
}

}  // namespace

void draw_section(App& app, const Box& box) {
    const LensSection& section = app.lens_made().section;
    if (section.rays.empty()) return;
    const SectionFrame at(app.lens_made(), box);
    ImDrawList* list = ImGui::GetWindowDrawList();
    drag_parts(app, at);
    list->PushClipRect(box.from, box.to, true);
    list->AddLine({box.from.x, float(at.middle)}, {box.to.x, float(at.middle)}, IM_COL32(90, 90, 90, 120));
    draw_glass(at, section);
    const std::vector<std::size_t> lit = lit_rays(app);
    for (const SectionRay& ray : section.rays)
        if (std::abs(ray.off_plane) < 1e-6)
            draw_path(at, ray, lit.empty() ? kRay : IM_COL32(150, 190, 120, 50), 1);
    for (const std::size_t i : lit) draw_path(at, section.rays[i], kLit, 1.2f);
    draw_parts(app, at);
    list->PopClipRect();
}

void drag_blades(App& app, const Box& box, const std::string& name) {
    struct Grabbed {
        int blades = 0;
        double rotation_deg = 0;
        bool turns = false;
    };
    static Grabbed grab;
    is_field(app, name, "drag sideways for more or fewer blades; drag the rim to rotate them");
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 middle = box.middle();
    // Offset from the middle, to the right and up.
    const auto from_middle = [&](const ImVec2& p) {
        return std::pair(double(p.x - middle.x), double(middle.y - p.y));
    };
    const ApertureShape& shape = app.state.choice.look.lens.aperture;
    if (ImGui::IsItemActivated()) {
        const auto [x, y] = from_middle(io.MousePos);
        grab = {shape.blades, shape.rotation_deg,
                shape.blades > 0 && std::hypot(x, y) > 0.36 * double(box.width())};
    }
    if (!ImGui::IsItemActive() || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return;
    const auto [x, y] = from_middle(io.MousePos);
    const auto [x0, y0] = from_middle(io.MouseClickedPos[0]);
    if (grab.turns) {
        const double turned = std::remainder(std::atan2(y, x) - std::atan2(y0, x0), 2 * std::numbers::pi);
        const double degrees = grab.rotation_deg + turned * 180 / std::numbers::pi;
        return void(act(app, "set lens.blade_rotation_deg " + text_of(std::remainder(degrees, 360.0), 4)));
    }
    // There are none, then three and more.
    constexpr int kMost = 24;
    const int steps = int(std::lround((x - x0) / double(ImGui::GetFontSize())));
    const int next = std::clamp(std::max(grab.blades - 2, 0) + steps, 0, kMost - 2);
    static_cast<void>(act(app, "set lens.blades " + std::to_string(next > 0 ? next + 2 : 0)));
}

}  // namespace petzval::view
