// petzval view: a window. apps/view draws it; this file holds its flags.
#include "petzval/scene.h"

#include "flags/defocus_flags.h"
#include "flags/look_rows.h"
#include "verbs.h"

#include <memory>
#include <utility>

#ifdef PETZVAL_VIEW
#include "view/view.h"
#endif

namespace petzval::cli {
namespace {

struct ViewFlags : DefocusFlags {
    std::string against, script, scene, scene_camera;
    std::optional<double> scale;
    std::optional<std::pair<int, int>> size, scene_size;
    std::optional<int> listen;
    std::vector<std::string> files;  // IN and flags that say where and what it is, as typed
};

Result<std::pair<int, int>> parse_window(const std::string& text) {
    const std::size_t x = text.find('x');
    if (x != std::string::npos) {
        const auto width = parse_size_px(text.substr(0, x)), height = parse_size_px(text.substr(x + 1));
        if (width && height) return std::pair(*width, *height);
    }
    return Error{ErrorCode::InvalidArgument, "not a width and a height, such as 1280x800"};
}

Result<int> parse_port(const std::string& text) {
    const auto port = parse_count(text);
    if (port && *port <= 65535) return port;
    return Error{ErrorCode::InvalidArgument, "not a port, 1 to 65535"};
}

#ifdef PETZVAL_VIEW

std::vector<view::FieldRow> field_rows() {
    std::vector<view::FieldRow> rows;
    for (const LookRow& row : look_rows()) {
        const auto way_back = [placeholder = row.placeholder](const std::string& json) {
            if (placeholder == "off|on") return std::string(json == "true" ? "on" : "off");
            return typed_text(json);
        };
        const auto way = row.placeholder.empty()
                             ? [](const std::string& text) { return Result<std::string>(text); }
                             : row.to_json;
        rows.push_back({row.heading, row.field, row.flag, row.placeholder, row.help, way, way_back});
    }
    return rows;
}

Status open_window(const ViewFlags& flags) {
    if (flags.ocio.is_on())
        if (Status fine = flags.ocio.try_out(); !fine) return fine;
    // A picture that is saved has no bar on the terminal.
    DefocusFlags quiet = static_cast<const DefocusFlags&>(flags);
    quiet.run.progress = ProgressMode::Off;
    quiet.output = "out.exr";  // of the example in a message
    view::Setup setup;
    setup.run = quiet.settings();
    setup.host = picture_host(quiet);
    setup.session_settings = flags.session();
    setup.typed_files = flags.files;
    setup.scene = flags.scene;
    setup.scene_camera = flags.scene_camera;
    if (flags.scene_size)
        setup.scene_width = flags.scene_size->first, setup.scene_height = flags.scene_size->second;
    setup.against = flags.against;
    setup.script = flags.script;
    setup.listen_port = flags.listen.value_or(0);
    setup.scale = flags.scale.value_or(0);
    if (flags.size) setup.width = flags.size->first, setup.height = flags.size->second;
    setup.fields = field_rows();
    return view::run(setup);
}

#else

Status open_window(const ViewFlags&) {
    return Error{ErrorCode::Unsupported,
                 "view: this petzval was built without a window; install libglfw3-dev and libimgui-dev and "
                 "build again"};
}

#endif

// Its name stands where that of a file would.
void check_scene(ViewFlags& flags) {
    if (flags.scene.empty() && is_scene_file(flags.input.path)) flags.scene.swap(flags.input.path);
    if (flags.scene.empty()) {
        if (flags.scene_size) throw UsageError("--scene-size has no effect without --scene");
        if (!flags.scene_camera.empty()) throw UsageError("--scene-camera has no effect without a glTF file");
        return;
    }
    refuse_both(!flags.input.path.empty(), "IN", true, "--scene");
    refuse(petzval::check_scene(flags.scene, flags.scene_camera));
    flags.input.path = flags.scene;
}

}  // namespace

void add_view(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "view", "open a window to find focus, aperture and lens with the mouse",
                          "petzval view beauty.exr\n"
                          "petzval view beauty.exr --lens doublet --against truth.exr\n"
                          "petzval view --scene tori --engine gaussian");
    auto flags = std::make_shared<ViewFlags>();
    flags->add_shown_to(verb);
    FlagGroup(verb, "Window")
        .reads("--against", "FILE", "another picture to compare with, such as the truth or an earlier frame",
               flags->against)
        .value("--scene", "NAME",
               "instead of IN: a built-in scene, or a .gltf or .glb file, rendered again whenever its camera "
               "moves",
               parse_text, flags->scene)
        .value("--scene-camera", "NAME",
               "camera of a glTF file, by name or by number from 1 (default: the first)", parse_text,
               flags->scene_camera)
        .value("--scene-size", "WxH", "size of its picture (default 480x270)", parse_window,
               flags->scene_size)
        .value("--listen", "PORT",
               "show pictures that renderers push to the viewer tev, on this port of this machine (tev's own "
               "is 14158). A pushed picture with a channel Z in metres replaces the picture; others are "
               "compared with it. Without IN the window waits for a picture",
               parse_port, flags->listen)
        .reads("--script", "FILE", "run the script in a file (docs/reference/window.md), then close",
               flags->script)
        .value("--window", "WxH", "size of the window (default 1280x800)", parse_window, flags->size)
        .value("--ui-scale", "FACTOR", "size of letters and widgets; the display's by default",
               parse_positive, flags->scale);
    when_typed(verb, [flags, &verb, &chosen] {
        check_scene(*flags);
        if (!flags->listen)
            require_argument(verb, flags->input.path, "an input picture, --scene or --listen");
        flags->check_shown();
        std::vector<std::string> of_look;
        for (const LookRow& row : look_rows()) of_look.emplace_back(row.flag);
        flags->files = typed_words(verb, {"Input", "Engine sprites"}, of_look);
        if (!flags->scene.empty()) flags->files = {flags->scene + ".exr"};
        chosen = [flags] { return open_window(*flags); };
    });
}

}  // namespace petzval::cli
