#include "panels.h"

#include "petzval/defocus.h"
#include "petzval/lens_facts.h"
#include "petzval/look_file.h"
#include "petzval/look_json.h"
#include "petzval/names.h"

#include "articles.h"
#include "canvas.h"
#include "commands.h"
#include "fields.h"
#include "widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <imgui.h>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace petzval::view {
namespace {

void run_line(App& app, const std::string& line) { static_cast<void>(act(app, line)); }

void command_button(App& app, const char* label, const std::string& line) {
    if (ImGui::Button(label)) run_line(app, line);
}

// Lenses that match the words, in the order asked for: as they stand on the shelf, by year, the fastest
// first.
std::vector<LensSummary> sorted_shelf(const char* words, int order) {
    static const std::vector<LensSummary> shelf = lens_list();
    std::vector<LensSummary> found = matching(shelf, words_of(words));
    const auto speed = [](const LensSummary& lens) { return lens.f_number > 0 ? lens.f_number : 1e9; };
    if (order == 1)
        std::stable_sort(found.begin(), found.end(),
                         [](const auto& a, const auto& b) { return a.year < b.year; });
    if (order == 2)
        std::stable_sort(found.begin(), found.end(),
                         [&](const auto& a, const auto& b) { return speed(a) < speed(b); });
    return found;
}

void preset_choice(App& app) {
    if (ImGui::Button("see all presets")) run_line(app, "sheet presets");
    is_field(app, "see presets", "this picture with each preset");
    if (!ImGui::BeginCombo("preset", "a whole look")) return;
    for (const LookPreset& preset : all_presets())
        if (ImGui::Selectable(preset.name.c_str())) run_line(app, "preset " + preset.name);
    ImGui::EndCombo();
}

// The marked lenses, else the first of those found, on this picture.
void sheet_button(App& app, const std::set<std::string>& marked, const std::vector<LensSummary>& found) {
    constexpr std::size_t kMost = 12;
    std::string names;
    std::size_t count = 0;
    for (const LensSummary& lens : found)
        if ((marked.empty() || marked.contains(lens.name)) && count < kMost) {
            names += (names.empty() ? "" : ",") + lens.name;
            ++count;
        }
    ImGui::BeginDisabled(count == 0);
    if (ImGui::Button(("see " + std::to_string(count) + " lenses").c_str())) run_line(app, "sheet " + names);
    ImGui::EndDisabled();
    is_field(app, "see lenses",
             "this picture through the marked lenses, each wide open. Ctrl-click marks a lens; "
             "without marks: the first of the list");
}

void shelf_panel(App& app) {
    static char words[128] = "";
    static int order = 0;
    static std::set<std::string> marked;  // with Ctrl held; for the sheet
    const std::string& now = app.state.choice.look.lens.name;
    preset_choice(app);
    ImGui::InputTextWithHint("find", "planar, 1954, triplet", words, sizeof words);
    is_field(app, "find lens", "words of its name, other names, year or kind");
    ImGui::Combo("sort", &order, "as listed\0by year\0fastest first\0");
    const std::vector<LensSummary> found = sorted_shelf(words, order);
    sheet_button(app, marked, found);
    ImGui::SameLine();
    if (ImGui::Button(app.state.lens ? "close bench" : "lens bench")) run_line(app, "toggle view.lens");
    is_field(app, "lens bench", "the lens in section, its discs and curves (L)");
    if (!ImGui::BeginListBox("##shelf", {-1, 9 * ImGui::GetTextLineHeightWithSpacing()})) return;
    for (const LensSummary& lens : found) {
        const bool is_marked = marked.contains(lens.name);
        if (is_marked) ImGui::PushStyleColor(ImGuiCol_Text, IM_COL32(255, 220, 90, 255));
        const bool is_clicked = ImGui::Selectable(lens.name.c_str(), lens.name == now);
        if (is_marked) ImGui::PopStyleColor();
        if (is_clicked && !ImGui::GetIO().KeyCtrl) run_line(app, "set lens " + lens.name);
        if (is_clicked && ImGui::GetIO().KeyCtrl && marked.erase(lens.name) == 0) marked.insert(lens.name);
        std::string title = lens.title + (lens.year.empty() ? "" : ", " + lens.year);
        if (lens.f_number > 0) title.insert(0, "f/" + text_of(lens.f_number, 3) + "  ");
        std::string known_as;
        for (const std::string& name : lens.names) known_as += (known_as.empty() ? "\nalso " : ", ") + name;
        is_field(app, "lens " + lens.name, title + known_as);
        ImGui::SameLine(11 * ImGui::GetFontSize());
        ImGui::TextDisabled("%s", title.c_str());
    }
    ImGui::EndListBox();
}

void display_panel(App& app) {
    slider_widget(app, "view.exposure", "exposure", {-8, 8, "%+.3g stops"});
    slider_widget(app, "view.contrast", "contrast", {0.25, 4, "%.3g", true});
    const struct {
        const char *word, *label;
        Channel channel;
    } channels[] = {{"rgb", "RGB", Channel::Colour},
                    {"r", "R", Channel::Red},
                    {"g", "G", Channel::Green},
                    {"b", "B", Channel::Blue},
                    {"a", "A", Channel::Alpha}};
    for (const auto& one : channels) {
        if (ImGui::RadioButton(one.label, app.state.channel == one.channel) &&
            app.state.channel != one.channel)
            run_line(app, std::string("channel ") + one.word);
        ImGui::SameLine();
    }
    ImGui::TextUnformatted("channel");
    const ToneCurve tone = app.state.choice.develop.tone;
    ImGui::BeginDisabled(app.state.choice.ocio);
    if (ImGui::BeginCombo("display transform", name_of(tone))) {
        for (const auto& known : names<ToneCurve>())
            if (ImGui::Selectable(known.name, known.value == tone))
                run_line(app, std::string("set view.tone ") + known.name);
        ImGui::EndCombo();
    }
    is_field(app, "view.tone", "tone curve before sRGB: filmic rolls highlights off, none clips them at 1");
    ImGui::EndDisabled();
    bool ocio = app.state.choice.ocio;
    ImGui::BeginDisabled(!app.setup().host.to_display);
    if (ImGui::Checkbox("OpenColorIO", &ocio)) run_line(app, "toggle view.ocio");
    ImGui::EndDisabled();
    is_field(app, "view.ocio",
             app.setup().host.to_display ? "display transform of the OpenColorIO configuration"
                                         : "start the window with $OCIO or --ocio CONFIG");
    light_plot(app);
}

// The tooltip says what the right half would show.
std::string about_side(const std::string& what) {
    static const std::map<std::string, std::string> known{
        {"sharp", "the picture before the blur"},
        {"against", "the second picture"},
        {"cpu", "the same frame, drawn by the CPU"},
        {"coc", "signed blur radii: near blue, far orange"},
        {"depth", "near bright, far dark"},
        {"scatter", "engine for final frames"},
        {"gather", "fast engine for previews"},
        {"gaussian", "fastest engine; its blur has no discs"},
        {"sprites", "gather, with each bright point drawn as a disc"},
        {"realtime", "GPU passes for games"},
        {"reference", "traced by many rays: slow, the definition of a correct result"}};
    const auto found = known.find(what);
    return found == known.end() ? "" : found->second;
}

void compare_panel(App& app) {
    const auto wipe_button = [&](const std::string& what) {
        if (ImGui::RadioButton(
                what == "coc" ? "radii" : what.c_str(),
                app.state.wiping && (name_of_side(app, app.state.right) == what ||
                                     (app.state.right.engine.empty() && app.state.right.shown == what))))
            run_line(app, "wipe " + what);
        is_field(app, "wipe " + what, about_side(what));
    };
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("right half:");
    ImGui::SameLine();
    if (ImGui::RadioButton("no comparison", !app.state.wiping)) run_line(app, "wipe off");
    is_field(app, "wipe off");
    wipe_button("sharp");
    if (app.against()) ImGui::SameLine(), wipe_button("against");
    if (app.setup().cpu_session) ImGui::SameLine(), wipe_button("cpu");
    ImGui::SameLine();
    wipe_button("coc");
    ImGui::SameLine();
    wipe_button("depth");
    int count = 0;
    for (const std::string& engine : engine_names()) {
        if (count++ % 3 != 0) ImGui::SameLine();
        const bool lacks_gpu = engine == "realtime" && !app.setup().cpu_session;
        ImGui::BeginDisabled(lacks_gpu);
        wipe_button(engine);
        ImGui::EndDisabled();
        if (lacks_gpu) is_field(app, "wipe " + engine, "needs a GPU: start the window with --device gpu");
    }
    if (ImGui::BeginCombo(app.state.wiping ? "left half" : "shown", app.state.left.shown.c_str())) {
        std::vector<std::string> names = shown_names();
        if (app.shot())
            for (const FrameLayer& layer : app.shot()->shot.layers)
                for (const std::string& kind : {kLayer, kSharpLayer}) names.push_back(kind + name_of(layer));
        for (const std::string& name : names)
            if ((!is_instanced(name) || app.setup().gl_context) &&
                ImGui::Selectable(name.c_str(), name == app.state.left.shown))
                run_line(app, "show \"" + name + "\"");
        ImGui::EndCombo();
    }
    bool overlay = app.state.overlay;
    if (ImGui::Checkbox("focus overlay", &overlay)) run_line(app, "toggle view.overlay");
    is_field(app, "view.overlay");
}

void files_panel(App& app) {
    static char frame[512] = "", look[512] = "look.json", lens[512] = "lens.json";
    if (frame[0] == 0) {
        const std::string stem = std::filesystem::path(app.state.choice.input.path).stem().string();
        (stem + "_focus.exr").copy(frame, sizeof frame - 1);
    }
    ImGui::InputText("##frame", frame, sizeof frame);
    ImGui::SameLine();
    command_button(app, "save frame", "save \"" + std::string(frame) + "\"");
    is_field(app, "save frame");
    ImGui::InputText("##look", look, sizeof look);
    ImGui::SameLine();
    command_button(app, "save look", "save_look \"" + std::string(look) + "\"");
    ImGui::InputText("##lens", lens, sizeof lens);
    ImGui::SameLine();
    command_button(app, app.bent() ? "save curves" : "save lens",
                   (app.bent() ? "save_curves \"" : "save_lens \"") + std::string(lens) + "\"");
    is_field(app, "save lens");
    if (app.is_live()) {
        static char recorded[512] = "";
        if (recorded[0] == 0) (app.setup().scene + "-####.exr").copy(recorded, sizeof recorded - 1);
        ImGui::InputText("##record", recorded, sizeof recorded);
        ImGui::SameLine();
        command_button(app, "record", "record \"" + std::string(recorded) + "\"");
    }
    command_button(app, "copy command", "copy");
    if (flowing_button("load look")) run_line(app, "load_look \"" + std::string(look) + "\"");
    if (flowing_button("reload")) run_line(app, "reload");
    if (flowing_button("to tev")) run_line(app, "tev");
}

std::string words_for(const char* name, const Rgba& p) {
    char text[160];
    std::snprintf(text, sizeof text, "%s %.4g %.4g %.4g %.3g", name, double(p.r), double(p.g), double(p.b),
                  double(p.a));
    return text;
}

void samples_of(App& app, const char* title, const DeepPicture& deep, int x, int y) {
    if (deep.empty() || x < 0 || y < 0 || x >= deep.width() || y >= deep.height()) return;
    const auto samples = deep.at(x, y);
    ImGui::Text("%s: %zu samples", title, samples.size());
    for (const DeepSample& sample : samples)
        ImGui::Text("%9.5g m  alpha %.3f   %.4g %.4g %.4g", double(sample.depth), double(sample.colour.a),
                    double(sample.colour.r), double(sample.colour.g), double(sample.colour.b));
    coverage_plot(app, title, samples);
}

const Rgba* pixel_of(const Picture* picture, const Rect& area, int x, int y) {
    return picture && area.contains(x, y) && picture->rect().contains(x - area.x0, y - area.y0)
               ? &(*picture)(x - area.x0, y - area.y0)
               : nullptr;
}

void colour_row(const std::string& name, const Rgba* p) {
    if (!p) return;
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(name.c_str());
    for (const float value : {p->r, p->g, p->b, p->a}) {
        ImGui::TableNextColumn();
        ImGui::Text("%.4g", double(value));
    }
}

// Raw numbers of all that there is at a pixel of the data window.
void colours_of(App& app, int x, int y) {
    const Shot& shot = app.shot()->shot;
    if (!ImGui::BeginTable("colours", 5, ImGuiTableFlags_RowBg)) return;
    for (const char* name : {"", "R", "G", "B", "A"}) ImGui::TableSetupColumn(name);
    ImGui::TableHeadersRow();
    const Rect data = shot.place.data_window;
    const SideFrames& frames = app.side(0);
    const int u = x + data.x0, v = y + data.y0;
    const Rgba* made = pixel_of(frames.detail.get(), frames.detail_area, u, v);
    if (!made && !is_buffer(app.state.left.shown))
        made = pixel_of(frames.whole.get(), frames.whole_area, u, v);
    colour_row(app.state.left.shown, made);
    colour_row("sharp", pixel_of(&shot.colour, data, u, v));
    if (const auto& other = app.against())
        colour_row("against", pixel_of(&other->shot.colour, other->shot.place.data_window, u, v));
    for (const FrameLayer& layer : shot.layers)
        colour_row(name_of(layer), pixel_of(&layer.colour, data, u, v));
    ImGui::EndTable();
}

// All that the files say of the picked pixel.
void pixel_panel(App& app) {
    if (!app.state.pick || !app.shot())
        return ImGui::TextWrapped("click a pixel; a right click keeps the focus");
    const Shot& shot = app.shot()->shot;
    const int x = app.state.pick->x + shot.place.display_window.x0 - shot.place.data_window.x0;
    const int y = app.state.pick->y + shot.place.display_window.y0 - shot.place.data_window.y0;
    if (!shot.colour.rect().contains(x, y)) return ImGui::TextWrapped("outside the picture");
    ImGui::Text("pixel %d, %d", app.state.pick->x, app.state.pick->y);
    if (const auto* depth = std::get_if<DepthMetres>(&shot.depth))
        ImGui::Text("depth %.6g m", double(depth->plane(x, y)));
    if (const auto radius = app.radius_at(*app.state.pick))
        ImGui::Text("radius %s", pixels_text(double(*radius)).c_str());
    colours_of(app, x, y);
    samples_of(app, "deep", shot.deep, x, y);
    samples_of(app, "hidden", shot.behind, x, y);
    samples_of(app, "holdout", shot.holdout, x, y);
}

void frame_panel(App& app) {
    const MadeFrame& made = app.side(0).last;
    if (made.engine.empty()) return;
    ImGui::TextWrapped("%s on %s, %s quality", made.engine.c_str(), made.device.c_str(),
                       name_of(made.quality));
    ImGui::TextWrapped("%s", made.lens.c_str());
    stage_times(made);
    for (const std::string& line : made.warnings) ImGui::TextWrapped("%s", line.c_str());
    if (!app.shot()) return;
    for (const std::string& line : app.shot()->shot.detected) ImGui::TextWrapped("%s", line.c_str());
}

using DrawPanel = void (*)(App&);

void section(App& app, const char* title, bool open, DrawPanel draw) {
    if (!ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0))
        return is_field(app, std::string("panel ") + title);
    is_field(app, std::string("panel ") + title);
    ImGui::PushID(title);
    draw(app);
    ImGui::PopID();
}

// The numbers under the pointer, raw.
std::string under_pointer(const App& app) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Mapping& m = app.mapping;
    const double px = double(mouse.x), py = double(mouse.y);
    if (px < m.x0 || py < m.y0 || px >= m.x0 + m.width || py >= m.y0 + m.height || !app.shot()) return "";
    const Place& place = app.shot()->shot.place;
    const int x = int(std::floor(m.frame_x(px))), y = int(std::floor(m.frame_y(py)));
    std::string line =
        std::to_string(x - place.display_window.x0) + ", " + std::to_string(y - place.display_window.y0);
    const SideFrames& frames = app.side(0);
    const Rgba* made = pixel_of(frames.detail.get(), frames.detail_area, x, y);
    if (!made) made = pixel_of(frames.whole.get(), frames.whole_area, x, y);
    if (made) line += "   " + words_for(app.state.left.shown.c_str(), *made);
    if (is_buffer(app.state.left.shown)) return line;
    if (const Rgba* sharp = pixel_of(&app.shot()->shot.colour, place.data_window, x, y))
        line += "   " + words_for("sharp", *sharp);
    if (const auto& other = app.against())
        if (const Rgba* p = pixel_of(&other->shot.colour, other->shot.place.data_window, x, y))
            line += "   " + words_for("against", *p);
    const PixelPosition pixel{x - place.display_window.x0, y - place.display_window.y0};
    if (const auto depth = app.depth_near(pixel)) line += "   " + text_of(*depth, 5) + " m";
    if (const auto radius = app.radius_at(pixel)) line += "   radius " + pixels_text(double(*radius));
    return line;
}

}  // namespace

void time_row(double seconds, const std::string& words) {
    char number[32];
    std::snprintf(number, sizeof number, "%.1f ms", 1000 * seconds);
    const float end = ImGui::GetCursorPosX() + 5.5f * ImGui::GetFontSize();
    ImGui::SetCursorPosX(end - ImGui::CalcTextSize(number).x);
    ImGui::Text("%s  %s", number, words.c_str());
}

void stage_times(const MadeFrame& made) {
    double rest = made.seconds;
    for (const StageTime& stage : made.stages) {
        time_row(stage.seconds, stage.stage);
        rest -= stage.seconds;
    }
    if (rest > 0.0005) time_row(rest, made.engine.empty() ? "radii" : made.engine + " besides");
    time_row(made.seconds, std::string("this frame, ") + name_of(made.quality));
}

void draw_panels(App& app) {
    ImGui::PushItemWidth(-11 * ImGui::GetFontSize());
    const bool is_article = article_of(app.setup().scene) != nullptr;
    if (is_article) section(app, "Article", true, article_panel);
    const bool has_depth = !app.shot() || !app.shot()->shot.depth_plane().empty();
    if (app.shot() && !app.is_live())
        section(app, has_depth ? "Input" : "Input: no depth", !has_depth, input_panel);
    section(app, "Camera", !is_article, camera_panel);
    if (app.shot()) section(app, "Depth", !is_article, depth_panel);
    section(app, "Lenses", false, shelf_panel);
    section(app, "Look", !is_article, look_panel);
    section(app, "Compare", !is_article, compare_panel);
    section(app, "Display", false, display_panel);
    section(app, "Files", false, files_panel);
    section(app, "Pixel", false, pixel_panel);
    section(app, "Frame", false, frame_panel);
    ImGui::PopItemWidth();
}

// Describes the picture on the screen and its quality.
std::string state_words(const App& app) {
    if (!app.shot()) return "nothing is open";
    const MadeFrame& made = app.side(0).last;
    const std::string& shown = app.state.left.shown;
    std::string words = shown == "result" ? "sharp" : shown;
    if (is_made(shown) && shown != "coc" && !made.engine.empty())
        words = made.engine + ", " + name_of(made.quality);
    return app.is_busy() ? words + " …" : words;
}

// File, size, zoom, frame and display.
std::string file_words(const App& app) {
    if (!app.shot()) return "H: help";
    const Rect& frame = app.shot()->shot.place.display_window;
    const DevelopSettings& develop = app.state.choice.develop;
    std::string words = std::filesystem::path(app.state.choice.input.path).filename().string();
    words += "   " + std::to_string(frame.width()) + " × " + std::to_string(frame.height());
    words += "   zoom " + text_of(std::round(100 * app.mapping.scale_y), 4) + " %";
    if (app.state.timeline.is_shot()) words += "   frame " + std::to_string(app.state.timeline.frame);
    words += app.state.choice.ocio
                 ? "   OpenColorIO"
                 : std::string("   ") +
                       (develop.transfer == Transfer::Srgb ? "sRGB" : name_of(develop.transfer)) + ", " +
                       (develop.tone == ToneCurve::None ? "clipped" : name_of(develop.tone));
    if (develop.exposure_stops != 0) words += "   exposure " + text_of(develop.exposure_stops, 3);
    if (develop.contrast != 1) words += "   contrast " + text_of(develop.contrast, 3);
    return words + "   H: help";
}

// Messages longer than a line also replace the values under the pointer.
void draw_status_line(App& app) {
    const std::string wrong = plain_words(app, app.error.empty() ? app.trouble : app.error);
    const std::string said = wrong.empty() ? plain_words(app, app.notice) : wrong;
    const std::string facts = file_words(app);
    const ImVec4 colour = !wrong.empty() ? ImVec4(1, 0.45f, 0.35f, 1)
                          : said.empty() ? ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled)
                                         : ImGui::GetStyleColorVec4(ImGuiCol_Text);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextWrapped("%s", said.empty() ? facts.c_str() : said.c_str());
    ImGui::PopStyleColor();
    if (ImGui::GetItemRectSize().y > 1.5f * ImGui::GetTextLineHeight()) return;
    const std::string state = state_words(app);
    const float place = ImGui::GetWindowWidth() - ImGui::CalcTextSize(state.c_str()).x - ImGui::GetFontSize();
    if (ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetFontSize() < place) {
        ImGui::SameLine(place);
        ImGui::TextDisabled("%s", state.c_str());
    }
    const std::string pointed = under_pointer(app);
    ImGui::TextUnformatted(pointed.empty() && !said.empty() ? facts.c_str() : pointed.c_str());
}

}  // namespace petzval::view
