#include "articles.h"

#include "petzval/names.h"

#include "app.h"
#include "commands.h"
#include "fields.h"
#include "panels.h"
#include "widgets.h"

#include <algorithm>
#include <imgui.h>

namespace petzval::view {
namespace {

Article hexadrive() {
    return {"hexadrive",
            "HexaDrive 2009: sprites of every pixel, levels in one buffer",
            {{"lens.blades", "5"},
             {"lens.blade_rotation_deg", "90"},
             {"lens.barrel", "80,30;85,-32"},
             {"glare.star", "0.1"},
             {"glare.bloom", "0.05"}},
            {{"camera.f_number", "f-number", 0.5, 8},
             {"camera.focus_distance_m", "focus, m", 0.6, 6},
             {"lens.blades", "blades", 0, 0},
             {"lens.barrel", "barrel", 0, 0},
             {"glare.star", "star", 0, 0.3},
             {"glare.bloom", "layered Gaussians", 0, 0.3},
             {"glare.ghosts", "ghosts", 0, 0.1}},
            {{"result", "result", ""},
             {"sharp, HDR", "sharp", ""},
             {"depth", "depth", ""},
             {"radii", "coc", ""},
             {"surfaces", "layers", ""},
             {"levels in one buffer", "levels", ""},
             {"highlights", "highlights", ""},
             {"blurred, no glare", "blurred", ""},
             {"glare alone", "glare", ""},
             {"2009: sprites", "sprites-2009", ""},
             {"2009: atlas", "atlas-2009", ""}}};
}

Article wgld() {
    return {"wgld",
            "wgld.org: sharp, small and large Gaussian mixed by depth",
            {{"engine", "gaussian"},
             {"gaussian.style", "wgld"},
             {"gaussian.depth_band_range_m", "0.1m,30m"},
             {"gaussian.depth_offset", "0.45"}},
            {{"gaussian.depth_offset", "depth offset", -0.5, 0.5},
             {"gaussian.focus_band", "band", 0, 1},
             {"gaussian.depth_along", "depth along", 0, 0},
             {"camera.f_number", "f-number (how large)", 0.7, 8}},
            {{"result", "result", ""},
             {"depth index", "focus-index", ""},
             {"sharp", "sharp", ""},
             {"small blur", "blur-small", ""},
             {"large blur", "blur-large", ""},
             {"temporary: rows", "blur-rows", ""},
             {"depth", "depth", ""}}};
}

Article unity() {
    return {
        "unity",
        "UWA, Catlike Coding, KinoBokeh: gather at half size, near and far",
        {{"engine", "gather"}, {"gather.stage", "cure"}, {"gather.taps", "71"}, {"gather.tap_offset", "1"}},
        {{"camera.focal_length_mm", "focal length, mm", 20, 120},
         {"camera.aperture_mm", "aperture, mm", 5, 100},
         {"camera.focus_distance_m", "focus, m", 0.8, 10},
         {"scene.follow", "focus on the green cube", 0, 0},
         {"gather.pixel_size_px", "pixel size, px", 0, 0.99},
         {"gather.blurred_px", "fully blurred from, px", 1, 4},
         {"gather.taps", "kernel size", 0, 0},
         {"gather.coc", "radius of 2 x 2", 0, 0}},
        {{"result: cure", "result", "cure"},
         {"radii", "result", "coc"},
         {"half size", "result", "prefilter"},
         {"taps that reach", "result", "taps"},
         {"blind disc", "result", "disc"},
         {"blind disc, four-tap blur", "result", "disc-blur"},
         {"hard test", "result", "hard-test"},
         {"four-tap blur", "result", "blur"},
         {"combined: hard edges", "result", "combine"},
         {"near and far", "result", "near-far"},
         {"sharp", "sharp", ""},
         {"depth", "depth", ""},
         {"ours", "result", "final"}}};
}

bool is_shown(const App& app, const ArticleBuffer& buffer) {
    return app.state.left.shown == buffer.shown &&
           (buffer.stage.empty() || buffer.stage == name_of(app.state.choice.look.gather.stage));
}

void control(App& app, const ArticleControl& of) {
    if (of.least < of.most) return slider_widget(app, of.path, of.label, {of.least, of.most});
    for (const FieldRow& row : app.setup().fields)
        if (row.path == of.path) return row_widget(app, row, of.label);
    switch_widget(app, of.path, of.label);
}

void times(const App& app) {
    const OpenShot& open = *app.shot();
    const MadeFrame& made = app.side(0).last;
    time_row(open.build_s, "scene built");
    time_row(open.render_s, "rays, " + std::to_string(open.samples) + " a pixel");
    stage_times(made);
}

}  // namespace

const Article* article_of(const std::string& scene) {
    static const std::vector<Article> all{hexadrive(), wgld(), unity()};
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Article& a) { return a.scene == scene; });
    return found == all.end() ? nullptr : &*found;
}

void begin_article(App& app) {
    const Article* article = article_of(app.setup().scene);
    if (!article || !(app.state.choice.look == Look{})) return;
    for (const auto& [field, value] : article->fields)
        if (Status done = set_field(app, field, value); !done) app.error = done.error().message;
}

void article_panel(App& app) {
    const Article* article = article_of(app.setup().scene);
    if (!article || !app.shot()) return;
    ImGui::TextWrapped("%s", article->title.c_str());
    for (const ArticleControl& one : article->controls) control(app, one);
    int count = 0;
    for (const ArticleBuffer& buffer : article->buffers) {
        if (count++ % 2 != 0) ImGui::SameLine(13 * ImGui::GetFontSize());
        if (ImGui::RadioButton(buffer.label.c_str(), is_shown(app, buffer)))
            static_cast<void>(act(app, "buffer \"" + buffer.label + "\""));
        is_field(app, "buffer " + buffer.label);
    }
    times(app);
}

}  // namespace petzval::view
