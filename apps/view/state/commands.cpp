#include "commands.h"

#include "petzval/defocus.h"
#include "petzval/look_file.h"
#include "petzval/names.h"
#include "petzval/output.h"

#include "articles.h"
#include "command_line.h"
#include "command_list.h"
#include "fields.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace petzval::view {
namespace {

using Words = std::vector<std::string>;

Result<PixelPosition> pixel_of(const Words& words) {
    const auto x = number_of(words[0]), y = number_of(words[1]);
    if (!x) return x.error();
    if (!y) return y.error();
    return PixelPosition{int(std::floor(*x)), int(std::floor(*y))};
}

Status pick(App& app, const Words& words) {
    const auto pixel = pixel_of(words);
    if (!pixel) return pixel.error();
    app.state.pick = *pixel;
    return Done{};
}

Status focus(App& app, const Words& words) {
    if (Status done = pick(app, words); !done) return done;
    if (app.shot() && app.shot()->shot.has_radii())
        return invalid("the file has blur radii instead of depth, so its focus is fixed");
    const auto depth = app.depth_near(*app.state.pick);
    if (!depth) return invalid("this pixel has no depth, like sky; click another pixel");
    if (Status done = set_field(app, "focus", text_of(*depth, 6)); !done) return done;
    app.notice = "focus " + text_of(*depth, 4) + " m";
    Timeline& line = app.state.timeline;
    if (line.rack_clicks > 0) return rack_to(app, *app.state.choice.camera.focus_distance_m);
    if (line.is_shot() && line.keying) line.keys[line.frame] = *app.state.choice.camera.focus_distance_m;
    return Done{};
}

// Focus by steps of a fiftieth of its distance, aperture by thirds of a stop.
Status focus_by(App& app, const Words& words) {
    const auto steps = number_of(words[0]);
    const auto now = app.found_camera().focus_distance_m;
    if (!steps) return steps.error();
    if (!now) return invalid("no focus yet; click the subject");
    return set_field(app, "focus", text_of(now->value * std::pow(1.02, *steps)));
}
Status stop_by(App& app, const Words& words) {
    const auto steps = number_of(words[0]);
    const auto now = app.found_camera().f_number;
    if (!steps) return steps.error();
    return set_field(app, "fstop", text_of((now ? now->value : 2.8) * std::exp2(*steps / 6), 6));
}

Status set(App& app, const Words& words) { return set_field(app, words[0], words[1]); }

Status exposure_by(App& app, const Words& words) {
    const auto by = number_of(words[0]);
    if (!by) return by.error();
    return set_field(app, "exposure", text_of(app.state.choice.develop.exposure_stops + *by));
}

Status toggle(App& app, const Words& words) {
    const auto now = field_text(app, words[0]);
    if (!now) return now.error();
    const bool is_switch = *now == "on" || *now == "off" || *now == "true" || *now == "false";
    if (!is_switch) return invalid(words[0] + " is not a switch");
    const bool on = *now == "on" || *now == "true";
    return set_field(app, words[0],
                     *now == "on" || *now == "off" ? (on ? "off" : "on") : (on ? "false" : "true"));
}

Status channel(App& app, const Words& words) {
    static const std::map<std::string, Channel> known{{"rgb", Channel::Colour},
                                                      {"r", Channel::Red},
                                                      {"g", Channel::Green},
                                                      {"b", Channel::Blue},
                                                      {"a", Channel::Alpha}};
    const auto found = known.find(words[0]);
    if (found == known.end()) return invalid("channel " + words[0] + ": not one of rgb, r, g, b, a");
    // The same key again shows all of them.
    app.state.channel = app.state.channel == found->second ? Channel::Colour : found->second;
    return Done{};
}

Status is_there(const App& app, const std::string& shown) {
    const auto layer = shown.starts_with(kLayer)        ? shown.substr(kLayer.size())
                       : shown.starts_with(kSharpLayer) ? shown.substr(kSharpLayer.size())
                                                        : "";
    if (!layer.empty()) {
        if (app.shot())
            for (const FrameLayer& known : app.shot()->shot.layers)
                if (name_of(known) == layer) return Done{};
        return invalid("show " + shown + ": no such layer is blurred; give --layers");
    }
    if (!has(shown_names(), shown))
        return invalid("show " + shown +
                       ": not one of result, sharp, against, coc, depth, a layer, a buffer of an engine");
    if (is_instanced(shown) && !app.setup().gl_context)
        return invalid("show " + shown + ": start the window with --scene hexadrive");
    if (shown == "against" && !app.against())
        return invalid("there is no second picture; give --against FILE");
    if (app.shot() &&
        ((shown == "hidden" && !app.shot()->hidden) || (shown == "holdout" && !app.shot()->holdout)))
        return invalid("show " + shown + ": there is none; give --" + (shown == "hidden" ? "plate" : shown));
    return Done{};
}

Status show(App& app, const Words& words) {
    if (Status there = is_there(app, words[0]); !there) return there;
    app.state.left.shown = words[0];
    return Done{};
}

// Shows a buffer of the scene's article, by its label.
Status buffer(App& app, const Words& words) {
    const Article* article = article_of(app.setup().scene);
    if (!article)
        return invalid("this scene has no buffers; start the window with --scene hexadrive, wgld or unity");
    for (const ArticleBuffer& one : article->buffers) {
        if (one.label != words[0]) continue;
        if (!one.stage.empty())
            if (Status done = set_field(app, "gather.stage", one.stage); !done) return done;
        return show(app, {one.shown});
    }
    return invalid("buffer " + words[0] + ": this scene has no such buffer");
}

// The other side of the wipe: something to show, or an engine.
Status wipe(App& app, const Words& words) {
    if (words[0] == "off" || (words[0] == "toggle" && app.state.wiping)) {
        app.state.wiping = false;
        return Done{};
    }
    if (words[0] == "toggle") {
        app.state.wiping = true;
        if (app.state.right == app.state.left) app.state.right = {app.against() ? "against" : "sharp", ""};
        return Done{};
    }
    const std::string& what = words[0];
    if (has(engine_names(), what))
        app.state.right = {"result", what};
    else if (what == "cpu" && !app.setup().cpu_session)
        return invalid("the CPU draws both sides; give --device gpu");
    else if (what == "cpu")
        app.state.right = {"result", "", true};
    else if (what == "against" && !app.against())
        return invalid("there is no second picture; give --against FILE");
    else if (has(shown_names(), what) && !is_buffer(what)) {
        if (Status there = is_there(app, what); !there) return there;
        app.state.right = {what, ""};
    } else
        return invalid("wipe " + what + ": not off, sharp, against, coc, depth, cpu or an engine");
    app.state.wiping = true;
    return Done{};
}

// Zooms about the middle of the visible part, or about a pixel of the frame that stays in place. The middle
// of the window always stays on the picture.
void keep_in_sight(App& app) {
    const Rect frame = app.frame();
    State& state = app.state;
    state.centre_x = std::clamp(state.centre_x, double(frame.x0), double(frame.x1));
    state.centre_y = std::clamp(state.centre_y, double(frame.y0), double(frame.y1));
}

Status zoom(App& app, const Words& words) {
    const Rect frame = app.frame();
    const double now = app.mapping.scale_y;
    const auto wanted = words[0] == "fit"   ? Result<double>(0.0)
                        : words[0] == "in"  ? Result<double>(std::min(256.0, now * 1.25))
                        : words[0] == "out" ? Result<double>(std::max(0.02, now / 1.25))
                                            : number_of(words[0]);
    if (!wanted) return invalid("zoom " + words[0] + ": not fit, in, out or a factor");
    if (*wanted < 0 || *wanted > 256) return invalid("zoom " + words[0] + ": not 0 (fit) to 256");
    State& state = app.state;
    if (state.zoom <= 0) state.centre_x = app.mapping.centre_x, state.centre_y = app.mapping.centre_y;
    if (words.size() == 3 && *wanted > 0) {
        const auto x = number_of(words[1]), y = number_of(words[2]);
        if (!x || !y) return invalid("zoom: not a pixel: " + words[1] + " " + words[2]);
        state.centre_x = *x + frame.x0 + (state.centre_x - *x - frame.x0) * now / *wanted;
        state.centre_y = *y + frame.y0 + (state.centre_y - *y - frame.y0) * now / *wanted;
    }
    state.zoom = *wanted;
    keep_in_sight(app);
    return Done{};
}

Status pan(App& app, const Words& words) {
    const auto x = number_of(words[0]), y = number_of(words[1]);
    if (!x || !y) return invalid("pan: not two numbers");
    State& state = app.state;
    if (state.zoom <= 0) {
        state.zoom = app.mapping.scale_y;
        state.centre_x = app.mapping.centre_x, state.centre_y = app.mapping.centre_y;
    }
    state.centre_x -= *x, state.centre_y -= *y;
    keep_in_sight(app);
    return Done{};
}

Status save(App& app, const Words& words) {
    app.error.clear();
    app.save(words[0]);
    return app.error.empty() ? Status(Done{}) : Status(invalid(app.error));
}
Status copy(App& app, const Words&) {
    if (app.shot() && app.shot()->is_pushed) return invalid("a pushed picture has no file; save it first");
    app.copied = command_line(app.setup(), app.full_choice(), "out.exr");
    if (app.is_live()) {
        std::string make;
        for (const std::string& word : scene_words(app.scene_wish(), app.setup().scene + ".exr"))
            make += word + " ";
        app.copied = make + "&& " + app.copied;
    }
    app.notice = "copied: " + app.copied;
    return Done{};
}
Status load_look(App& app, const Words& words) {
    auto look = read_look(words[0]);
    if (!look) return look.error();
    app.state.choice.look = std::move(*look);
    app.notice = "look: " + words[0];
    return Done{};
}
Status preset(App& app, const Words& words) {
    auto look = read_preset(words[0]);
    if (!look) return look.error();
    app.state.choice.look = std::move(*look);
    app.notice = "preset: " + words[0];
    return Done{};
}
Status save_look(App& app, const Words& words) {
    if (Status fine = app.may_write(words[0]); !fine) return fine;
    if (Status done = write_look(app.state.choice.look, words[0]); !done) return done;
    app.notice = "wrote " + words[0];
    return Done{};
}
Status light(App& app, const Words& words) {
    const auto x = number_of(words[0]), y = number_of(words[1]);
    if (!x || !y) return invalid("light: not two numbers");
    app.state.lit = {*x, *y};
    return Done{};
}
// A look that chooses a lens and nothing else.
Status save_lens(App& app, const Words& words) {
    const Look& now = app.state.choice.look;
    Look lens;
    lens.lens = now.lens;
    lens.aperture_image = now.aperture_image;
    lens.kernel_image_far = now.kernel_image_far, lens.kernel_image_near = now.kernel_image_near;
    if (Status fine = app.may_write(words[0]); !fine) return fine;
    if (Status done = write_look(lens, words[0]); !done) return done;
    app.notice = "wrote " + words[0];
    return Done{};
}
// A zone of the pupil, millimetres along the axis, and of one wavelength alone if it is named.
Status bend(App& app, const Words& words) {
    std::vector<double> numbers;
    for (const std::string& word : words)
        if (const auto number = number_of(word)) numbers.push_back(*number);
    const bool fine = numbers.size() == words.size() && (words.size() == 2 || words.size() == 3) &&
                      numbers[0] >= 0 && numbers[0] <= 1 && std::abs(numbers[1]) < 1000;
    if (!fine)
        return invalid("bend needs a zone from 0 to 1 and millimetres; a wavelength in nm is optional");
    return app.bend_lens(numbers[0], numbers[1], words.size() == 3 ? numbers[2] : 0);
}
Status save_curves(App& app, const Words& words) {
    if (!app.bent()) return invalid("no curve has been bent yet; press L to show the curves");
    if (Status fine = app.may_write(words[0]); !fine) return fine;
    if (Status done = write_text(words[0], lens_file_text(*app.bent())); !done) return done;
    app.state.choice.look.lens.name = words[0];
    app.notice = "wrote " + words[0] + ", and uses it; load it elsewhere with --lens";
    return Done{};
}
Status push(App& app, const Words& words) {
    const auto port = words.empty() ? Result<double>(double(kTevPort)) : number_of(words[0]);
    if (!port || *port < 1 || *port > 65535) return invalid("tev " + words[0] + ": not a port, 1 to 65535");
    return app.push(int(*port));
}
Status reload(App& app, const Words&) {
    app.read_again(true);
    return Done{};
}
Status open(App& app, const Words& words) {
    app.error.clear();
    app.open(words[0]);
    return app.error.empty() ? Status(Done{}) : Status(invalid(app.error));
}
Status undo(App& app, const Words&) { return app.undo(false); }
Status redo(App& app, const Words&) { return app.undo(true); }
Status reset(App& app, const Words& words) { return reset_field(app, words[0]); }
Status quit(App& app, const Words&) {
    app.quit = true;
    return Done{};
}

int count_of(const std::string& arguments) {
    int count = arguments.empty() ? 0 : 1;
    for (const char c : arguments) count += c == ' ' ? 1 : 0;
    return count;
}

}  // namespace

const std::vector<Command>& commands() {
    static const std::vector<Command> all{
        {"focus", "X Y", "focus on the surface at this pixel", focus},
        {"pick", "X Y", "print the values of this pixel", pick},
        {"focus_by", "STEPS", "focus 2 % farther per step; negative: nearer", focus_by},
        {"stop_by", "STEPS", "close the aperture by a third of a stop per step; negative: open it", stop_by},
        {"set", "FIELD VALUE", "set a field of camera, look or view, such as lens.blades", set},
        {"toggle", "FIELD", "switch a field on or off", toggle},
        {"exposure_by", "STOPS", "brighten the display; negative: darken it", exposure_by},
        {"channel", "rgb|r|g|b|a", "show one channel; the same again shows all", channel},
        {"buffer", "NAME", "show a buffer of a published method", buffer},
        {"show", "NAME", "show result, sharp, against, coc, depth, or a buffer of an engine", show},
        {"wipe", "NAME|off", "compare with sharp, against, coc, depth, another engine or cpu", wipe},
        {"zoom", "fit|in|out|FACTOR [X Y]", "zoom around the middle, or around a pixel", zoom},
        {"pan", "DX DY", "move the picture by pixels", pan},
        {"save", "FILE", "save the frame at the look's quality, as defocus does", save},
        {"copy", "", "copy the command that makes this frame", copy},
        {"load_look", "FILE", "load a look", load_look},
        {"preset", "NAME", "load a built-in look or one of your own", preset},
        {"sheet", "LENS,LENS|presets|off",
         "show this picture through each lens or preset; click one to use it", sheet},
        {"save_look", "FILE", "save the look", save_look},
        {"light", "X Y", "highlight the rays that land at this place of the disc, in pixels from its middle",
         light},
        {"bend", "ZONE MM [NM]", "move the focus of a zone of the pupil; positive: away from the lens", bend},
        {"save_curves", "FILE", "save the bent curves as a lens file", save_curves},
        {"tev", "[PORT]", "send the result to the viewer tev on this machine (default port 14158)", push},
        {"save_lens", "FILE", "save the lens as a look", save_lens},
        {"frame", "N|+1|-1|first|last", "go to a frame of the shot", frame},
        {"range", "FIRST LAST", "play these frames", range},
        {"key_focus", "", "set a focus key at this frame", key_focus},
        {"move_key", "FRAME TO METRES", "move a focus key to another frame and distance", move_key},
        {"rack", "", "begin a rack: click the subject at the first frame, then at the last", rack},
        {"remove_key", "", "remove the focus key of this frame", remove_key},
        {"save_track", "FILE", "save the focus keys as a track for defocus --track", save_track},
        {"load_track", "FILE", "load a track", load_track},
        {"orbit", "YAW PITCH", "turn the camera of a scene around the focused point, in degrees", orbit},
        {"dolly", "FACTOR", "multiply the camera's distance", dolly},
        {"home", "", "go back to the camera of the scene", home},
        {"record", "FILE-####.exr",
         "write sharp frames of a scene with depth for defocus; .png: the frames as shown", record},
        {"save_path", "FILE", "save the path of the camera, frame by frame", save_path},
        {"load_path", "FILE", "load a path of the camera", load_path},
        {"forget_path", "", "delete the path of the camera", forget_path},
        {"undo", "", "undo the last change", undo},
        {"redo", "", "redo what was undone", redo},
        {"reset", "FIELD|look", "set a field to its default", reset},
        {"open", "FILE", "open another picture, or a shot by its pattern", open},
        {"reload", "", "reload the files", reload},
        {"quit", "", "close the window", quit},
    };
    return all;
}

std::vector<std::string> words_of(const std::string& line) {
    Words words;
    bool quoted = false, open = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
            if (quoted && !open) words.emplace_back(), open = true;
        } else if ((c == ' ' || c == '\t' || c == '\r') && !quoted) {
            open = false;
        } else {
            if (!open) words.emplace_back(), open = true;
            words.back() += c;
        }
    }
    return words;
}

Status act(App& app, const std::string& line) {
    Words words = words_of(line);
    if (words.empty()) return Done{};
    Status done = invalid("unknown command " + words[0] + "; H shows them");
    for (const Command& command : commands()) {
        if (command.name != words[0]) continue;
        words.erase(words.begin());
        const std::size_t bracket = command.arguments.find('[');
        const std::string needed = command.arguments.substr(0, bracket > 0 ? bracket - 1 : 0);
        const bool may_end = bracket != std::string::npos && int(words.size()) == count_of(needed);
        if (int(words.size()) == count_of(command.arguments) || may_end)
            done = command.run(app, words);
        else
            done = invalid(command.name + " needs " +
                           (command.arguments.empty() ? "nothing" : command.arguments));
        break;
    }
    app.error = done ? "" : done.error().message;
    app.note_action();
    return done;
}

}  // namespace petzval::view
