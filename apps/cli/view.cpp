// petzval view: a window. apps/view draws it; this file holds its flags and the services it needs: command
// lines, frames written like those of defocus, OpenColorIO.
#include "petzval/lens_facts.h"
#include "petzval/reports/words.h"
#include "petzval/scene.h"

#include "console/console.h"
#include "defocus_frames.h"
#include "flags/defocus_flags.h"
#include "flags/fields.h"
#include "flags/look_rows.h"
#include "verbs.h"

#include <algorithm>
#include <cmath>
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

void add_number(std::vector<std::string>& words, const char* flag, const std::optional<double>& value) {
    if (value) words.insert(words.end(), {flag, plain(*value, 9)});
}

// The files as typed, unless others were chosen in the window.
std::vector<std::string> input_words(const ViewFlags& flags, const view::InputChoice& input) {
    if (input == view::input_of(flags.input.source())) return flags.files;
    std::vector<std::string> words{input.path};
    const auto add = [&](const char* flag, const std::string& text) {
        if (!text.empty()) words.insert(words.end(), {flag, text});
    };
    add("--layer", input.layer);
    add("--view-name", input.view_name);
    add("--depth", input.depth_file);
    add("--depth-channel", input.depth_channel);
    if (input.depth_kind) add("--depth-kind", name_of(*input.depth_kind));
    if (input.depth_near && input.depth_far)
        add("--depth-range", plain(*input.depth_near, 9) + "," + plain(*input.depth_far, 9));
    if (input.unit_scale_m != 1) add_number(words, "--unit-scale", input.unit_scale_m);
    return words;
}

std::vector<std::string> command_words(const ViewFlags& flags, const view::Choice& choice,
                                       const std::string& output) {
    std::vector<std::string> words{"petzval", "defocus"};
    for (const std::string& word : input_words(flags, choice.input))
        words.push_back(choice.frame ? at_frame(word, *choice.frame) : word);
    words.insert(words.end(), {"-o", output});
    if (flags.device != "cpu") words.insert(words.end(), {"--device", flags.device});
    add_number(words, "--fstop", choice.camera.f_number);
    if (!choice.camera.f_number) add_number(words, "--aperture-diameter", choice.camera.aperture_diameter_mm);
    add_number(words, "--focus", choice.camera.focus_distance_m);
    add_number(words, "--focal-length", choice.camera.focal_length_mm);
    add_number(words, "--sensor-width", choice.camera.sensor_width_mm);
    if (choice.camera.image_scale != ImageScale::Rendered)
        words.insert(words.end(),
                     {"--breathing", choice.camera.image_scale == ImageScale::ThinLens ? "on" : "off"});
    for (std::string& word : words_of(choice.look)) words.push_back(std::move(word));
    if (!output.ends_with(".png")) return words;
    if (choice.ocio) {
        words.insert(words.end(), {"--ocio", flags.ocio.view});
        if (!flags.ocio.space.empty()) words.insert(words.end(), {"--ocio-space", flags.ocio.space});
    } else {
        words.insert(words.end(), {"--tone", name_of(choice.develop.tone)});
        if (choice.develop.contrast != 1) add_number(words, "--contrast", choice.develop.contrast);
    }
    if (choice.develop.exposure_stops != 0) add_number(words, "--exposure", choice.develop.exposure_stops);
    return words;
}

std::string command_line(const ViewFlags& flags, const view::Choice& choice, const std::string& output) {
    std::string line;
    for (const std::string& word : command_words(flags, choice, output))
        line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

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

Result<Picture> ocio_codes(const OcioFlags& flags, View<const Rgba> light) {
    Picture copy = Picture::uninitialised(light.width(), light.height());
    for (int y = 0; y < light.height(); ++y) std::copy_n(light.row(y), light.width(), copy.row(y));
    DevelopSettings settings;
    std::string used;
    std::vector<std::string> warnings;
    if (Status done = flags.show(copy, settings, used, warnings); !done) return done.error();
    return copy;
}

// With the widest aperture of the lens as a number, where --fstop open asks for it.
Result<CameraFlags> camera_of(const ViewFlags& flags) {
    CameraFlags camera = flags.camera;
    if (!camera.choice().wide_open) return camera;
    const auto lens = Lens::open(flags.look.look().lens);
    if (!lens) return lens.error();
    const auto widest = widest_f_number(*lens);
    if (!widest) return widest.error();
    camera.f_number = *widest;
    return camera;
}

Status open_window(const ViewFlags& flags) {
    if (flags.ocio.is_on())
        if (Status fine = flags.ocio.try_out(); !fine) return fine;
    view::Setup setup;
    setup.scene = flags.scene;
    setup.choice.scene_camera = flags.scene_camera;
    if (flags.scene_size)
        setup.scene_width = flags.scene_size->first, setup.scene_height = flags.scene_size->second;
    const auto camera = camera_of(flags);
    if (!camera) return camera.error();
    setup.source = flags.input.source(*camera);
    setup.source.lights = flags.points;
    setup.choice.camera = camera->choice();
    setup.choice.look = flags.look.look();
    setup.choice.develop = flags.develop.settings(false, flags.input.transfer, flags.run.threads);
    setup.choice.develop.dither = false;  // the same codes wherever a part of it begins
    setup.choice.ocio = flags.ocio.is_on();
    setup.tone_is_chosen = flags.develop.tone.has_value();
    setup.focus_at = flags.focus.focus_at;
    setup.focus_point = flags.focus.focus_point;
    setup.permissible_radius_px = flags.focus.permissible_radius_px.value_or(1);
    setup.against = flags.against;
    setup.script = flags.script;
    setup.listen_port = flags.listen.value_or(0);
    setup.scale = flags.scale.value_or(0);
    if (flags.size) setup.width = flags.size->first, setup.height = flags.size->second;
    setup.fields = field_rows();
    for (const std::string& file : files_of(flags.input)) setup.files.reads(file);
    for (const std::string& file : {flags.points, flags.against, flags.script}) setup.files.reads(file);
    for (const std::string& file : files_of(flags.look.look())) setup.files.reads(file);
    setup.session = std::make_shared<Session>(flags.session());
    if (flags.device != "cpu") {
        SessionSettings settings = flags.session();
        settings.device = "cpu";
        setup.cpu_session = std::make_shared<Session>(settings);
    }
    setup.command_line = [&](const view::Choice& choice, const std::string& output) {
        return command_line(flags, choice, output);
    };
    // A picture that is saved has no bar on the terminal.
    DefocusFlags quiet = static_cast<const DefocusFlags&>(flags);
    quiet.run.progress = ProgressMode::Off;
    quiet.output = "out.exr";  // of the example in a message
    setup.run = quiet.settings();
    setup.host = picture_host(quiet);
    if (flags.ocio.is_on())
        setup.ocio_codes = [&](View<const Rgba> light) { return ocio_codes(flags.ocio, light); };
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
    if (const Status fine = petzval::check_scene(flags.scene, flags.scene_camera); !fine)
        throw UsageError(in_flags(fine.error().message));
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
