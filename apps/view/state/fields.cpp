#include "fields.h"

#include "petzval/look_check.h"
#include "petzval/look_json.h"
#include "petzval/names.h"

#include "field_list.h"
#include "lens_panel.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

namespace petzval::view {
namespace {

using Json = nlohmann::ordered_json;

// A number of the window, within limits.
Field number(const char* name, double& (*of)(State&), double least, double most) {
    return {name, [of](const App& app) { return text_of(of(const_cast<State&>(app.state)), 6); },  // NOLINT
            [=](App& app, const std::string& text) -> Status {
                const auto value = number_of(text);
                if (!value) return value.error();
                if (*value < least || *value > most)
                    return invalid(std::string(name) + " " + text + ": not " + text_of(least, 6) + " to " +
                                   text_of(most, 6));
                of(app.state) = *value;
                return Done{};
            }};
}

Field with_default(Field field, std::string standard) {
    field.standard = std::move(standard);
    return field;
}

Field toggle(const char* name, bool& (*of)(State&)) {
    return {name,
            [of](const App& app) { return of(const_cast<State&>(app.state)) ? "on" : "off"; },  // NOLINT
            [=](App& app, const std::string& text) -> Status {
                if (text != "on" && text != "off")
                    return invalid(std::string(name) + " " + text + ": not on or off");
                of(app.state) = text == "on";
                return Done{};
            }};
}

// A number of the camera: the file's until it is chosen; "file" gives it back.
Field camera_number(const char* name, std::optional<double> CameraChoice::*chosen,
                    std::optional<FoundNumber> FoundCamera::*found) {
    return {name,
            [=](const App& app) {
                const auto known = app.found_camera().*found;
                return known ? text_of(known->value, 6) : std::string("unknown");
            },
            [=](App& app, const std::string& text) -> Status {
                if (text == "file") {
                    (app.state.choice.camera.*chosen).reset();
                    return Done{};
                }
                const auto value = number_of(text);
                if (!value) return value.error();
                if (!(*value > 0)) return invalid(std::string(name) + " " + text + ": not more than 0");
                app.state.choice.camera.*chosen = *value;
                return Done{};
            },
            "file"};
}

// The aperture's diameter instead of the f-number.
Field aperture() {
    return {"camera.aperture_mm",
            [](const App& app) {
                const FoundCamera known = app.found_camera();
                if (!known.f_number || !known.focal_length_mm) return std::string("unknown");
                return text_of(known.focal_length_mm->value / known.f_number->value, 6);
            },
            [](App& app, const std::string& text) -> Status {
                const auto value = number_of(text);
                const auto focal = app.found_camera().focal_length_mm;
                if (!value || !(*value > 0))
                    return invalid("camera.aperture_mm " + text + ": not more than 0");
                if (!focal) return invalid("no focal length; set camera.focal_length_mm");
                app.state.choice.camera.f_number = focal->value / *value;
                return Done{};
            }};
}

// The camera of a glTF scene: its name, or number from 1.
Field own_camera() {
    return {"scene.camera",
            [](const App& app) {
                const std::string& chosen = app.state.choice.scene_camera;
                const bool has_names = app.shot() && !app.shot()->cameras.empty();
                return chosen.empty() && has_names ? app.shot()->cameras.front() : chosen;
            },
            [](App& app, const std::string& text) -> Status {
                if (!app.shot() || app.shot()->cameras.empty())
                    return invalid("scene.camera is for glTF files with cameras");
                const auto& names = app.shot()->cameras;
                const auto number = number_of(text);
                if (std::find(names.begin(), names.end(), text) == names.end() &&
                    !(number && *number >= 1 && *number <= double(names.size()))) {
                    std::string known;
                    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
                    return invalid("scene.camera " + text + ": the file has no camera of that name; it has " +
                                   known);
                }
                app.state.choice.scene_camera = text;
                app.turn_to({});
                return Done{};
            }};
}

// The focus stays on the scene's subject, from now on.
Field follow() {
    Field field = toggle(
        "scene.follow", +[](State& s) -> bool& { return s.following; });
    field.set = [set = field.set](App& app, const std::string& text) -> Status {
        if (Status done = set(app, text); !done) return done;
        if (app.state.following && app.shot() && app.shot()->subject_m)
            app.state.choice.camera.focus_distance_m = app.shot()->subject_m;
        return Done{};
    };
    return field;
}

template <typename E>
Field word(const char* name, E& (*of)(State&)) {
    return {name, [of](const App& app) { return name_of(of(const_cast<State&>(app.state))); },  // NOLINT
            [=](App& app, const std::string& text) -> Status {
                const auto value = parse<E>(text);
                if (!value) return invalid(std::string(name) + " " + text + ": " + value.error().message);
                of(app.state) = *value;
                return Done{};
            }};
}

Field fact(const char* name, std::function<std::string(const App&)> get) {
    return {name, std::move(get), nullptr};
}

std::string or_unknown(const std::optional<double>& value) { return value ? text_of(*value, 6) : "unknown"; }

std::vector<Field> facts() {
    return {
        fact("error",
             [](const App& app) { return plain_words(app, app.error.empty() ? app.trouble : app.error); }),
        fact("notice", [](const App& app) { return plain_words(app, app.notice); }),
        fact("copied", [](const App& app) { return app.copied; }),
        fact("pick.x",
             [](const App& app) { return app.state.pick ? std::to_string(app.state.pick->x) : ""; }),
        fact("pick.y",
             [](const App& app) { return app.state.pick ? std::to_string(app.state.pick->y) : ""; }),
        fact("pick.depth_m",
             [](const App& app) {
                 return or_unknown(app.state.pick ? app.depth_near(*app.state.pick) : std::nullopt);
             }),
        fact("pick.radius_px",
             [](const App& app) {
                 const auto radius = app.state.pick ? app.radius_at(*app.state.pick) : std::nullopt;
                 return radius ? text_of(double(*radius), 6) : std::string("unknown");
             }),
        fact("frame.engine", [](const App& app) { return app.side(0).last.engine; }),
        fact("frame.device", [](const App& app) { return app.side(0).last.device; }),
        fact("frame.quality", [](const App& app) { return name_of(app.side(0).last.quality); }),
        fact("frame.width", [](const App& app) { return std::to_string(app.frame().width()); }),
        fact("frame.height", [](const App& app) { return std::to_string(app.frame().height()); }),
        fact("frame.made_width",
             [](const App& app) {
                 const auto& wish = app.side(0).wish;
                 if (!wish || !app.shot()) return std::string("0");
                 return std::to_string(wish->region.value_or(app.shot()->shot.place.data_window).width());
             }),
        fact("left.shown", [](const App& app) { return app.state.left.shown; }),
    };
}

// Facts about scene, shot and lens, with times.
std::vector<Field> more_facts() {
    return {
        fact("scene.subject_m",
             [](const App& app) { return or_unknown(app.shot() ? app.shot()->subject_m : std::nullopt); }),
        fact("scene.build_ms",
             [](const App& app) { return app.shot() ? text_of(1000 * app.shot()->build_s, 4) : "0"; }),
        fact("scene.render_ms",
             [](const App& app) { return app.shot() ? text_of(1000 * app.shot()->render_s, 4) : "0"; }),
        fact("scene.samples",
             [](const App& app) { return app.shot() ? std::to_string(app.shot()->samples) : "0"; }),
        fact("scene.path_keys", [](const App& app) { return std::to_string(app.state.path.keys.size()); }),
        fact("frame.ms", [](const App& app) { return text_of(1000 * app.side(0).last.seconds, 4); }),
        fact("frame.passes",
             [](const App& app) {
                 std::string names;
                 for (const StageTime& stage : app.side(0).last.stages)
                     names += (names.empty() ? "" : ", ") + stage.stage;
                 return names;
             }),
        fact("orbit.yaw_deg", [](const App& app) { return text_of(app.state.orbit.yaw_deg, 6); }),
        fact("orbit.pitch_deg", [](const App& app) { return text_of(app.state.orbit.pitch_deg, 6); }),
        fact("shot.frame", [](const App& app) { return std::to_string(app.state.timeline.frame); }),
        fact("shot.keys", [](const App& app) { return std::to_string(app.state.timeline.keys.size()); }),
        fact("lens.rays", [](const App& app) { return std::to_string(app.lens_made().section.rays.size()); }),
        fact("lens.lit_rays", [](const App& app) { return std::to_string(lit_rays(app).size()); }),
        fact("lens.bent_mm",  // of the rim
             [](const App& app) {
                 return app.bent() ? text_of(app.bent()->curves.shift_mm[0].back(), 6) : std::string("0");
             }),
        fact("against.width",
             [](const App& app) {
                 return app.against() ? std::to_string(app.against()->shot.colour.width()) : std::string("0");
             }),
        fact("lens.disc_px",
             [](const App& app) {
                 const LensMade& made = app.lens_made();
                 return std::to_string(std::lround(double(made.disc.width) / made.fine));
             }),
        fact("slowest.tick_ms", [](const App& app) { return text_of(app.slowest.tick, 4); }),
        fact("last.picture_ms", [](const App& app) { return text_of(app.slowest.last_picture, 4); }),
        fact("slowest.cancel_ms", [](const App& app) { return text_of(app.slowest.cancel, 4); }),
        fact("slowest.picture_ms", [](const App& app) { return text_of(app.slowest.first_picture, 4); }),
    };
}

std::vector<Field> choices() {
    return {
        camera_number("camera.focal_length_mm", &CameraChoice::focal_length_mm,
                      &FoundCamera::focal_length_mm),
        camera_number("camera.sensor_width_mm", &CameraChoice::sensor_width_mm,
                      &FoundCamera::sensor_width_mm),
        camera_number("camera.f_number", &CameraChoice::f_number, &FoundCamera::f_number),
        camera_number("camera.focus_distance_m", &CameraChoice::focus_distance_m,
                      &FoundCamera::focus_distance_m),
        with_default(
            word<ImageScale>(
                "camera.image_scale", +[](State& s) -> ImageScale& { return s.choice.camera.image_scale; }),
            name_of(ImageScale::Rendered)),
        with_default(number(
                         "view.exposure",
                         +[](State& s) -> double& { return s.choice.develop.exposure_stops; }, -30, 30),
                     "0"),
        with_default(
            number(
                "view.contrast", +[](State& s) -> double& { return s.choice.develop.contrast; }, 0.1, 10),
            "1"),
        word<ToneCurve>(
            "view.tone", +[](State& s) -> ToneCurve& { return s.choice.develop.tone; }),
        toggle(
            "view.ocio", +[](State& s) -> bool& { return s.choice.ocio; }),
        toggle(
            "view.overlay", +[](State& s) -> bool& { return s.overlay; }),
        toggle(
            "view.final", +[](State& s) -> bool& { return s.final_quality; }),
        toggle(
            "view.open", +[](State& s) -> bool& { return s.opening; }),
        toggle(
            "view.panels", +[](State& s) -> bool& { return s.panels; }),
        toggle(
            "shot.playing", +[](State& s) -> bool& { return s.timeline.playing; }),
        toggle(
            "shot.keying", +[](State& s) -> bool& { return s.timeline.keying; }),
        toggle(
            "shot.easing", +[](State& s) -> bool& { return s.timeline.easing; }),
        aperture(),
        own_camera(),
        follow(),
        toggle(
            "scene.recording", +[](State& s) -> bool& { return s.path.recording; }),
        toggle(
            "view.lens", +[](State& s) -> bool& { return s.lens; }),
        toggle(
            "view.help", +[](State& s) -> bool& { return s.help; }),
        number(
            "shot.focus_speed", +[](State& s) -> double& { return s.timeline.focus_speed; }, 0, 1000),
        number(
            "view.wipe", +[](State& s) -> double& { return s.wipe; }, 0, 1),
        number(
            "view.zoom", +[](State& s) -> double& { return s.zoom; }, 0, 256),
        number(
            "view.centre_x", +[](State& s) -> double& { return s.centre_x; }, -1e6, 1e6),
        number(
            "view.centre_y", +[](State& s) -> double& { return s.centre_y; }, -1e6, 1e6),
    };
}

const Field* find(const std::string& name) {
    static const std::vector<Field> all = [] {
        std::vector<Field> fields = choices();
        for (Field& one : facts()) fields.push_back(std::move(one));
        for (Field& one : more_facts()) fields.push_back(std::move(one));
        for (Field& one : input_fields()) fields.push_back(std::move(one));
        return fields;
    }();
    for (const Field& field : all)
        if (field.name == name) return &field;
    return nullptr;
}

// The value of a look's field as text.
Result<std::string> text_in(const App& app, const Json& look, const std::string& path);

// The look as JSON, kept while it is the same: every widget asks for its field at every tick.
const Json& json_of(const Look& look) {
    static Look kept;
    static Json json = Json::parse(look_to_json(kept));
    if (!(kept == look)) kept = look, json = Json::parse(look_to_json(look));
    return json;
}

const FieldRow* row_of(const App& app, const std::string& path) {
    for (const FieldRow& row : app.setup().fields)
        if (row.path == path) return &row;
    return nullptr;
}

}  // namespace

std::string text_of(double value, int digits) {
    if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
    char text[64];
    char* const end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
    return {text, end};
}

std::string pixels_text(double px) {
    char text[64];
    std::snprintf(text, sizeof text, "%.2f px", std::abs(px) < 0.005 ? 0 : px);
    return text;
}

Result<double> number_of(const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const char* begin = text.data() + (text.starts_with("+") ? 1 : 0);
    const auto [stopped, failed] = std::from_chars(begin, end, value);
    if (failed != std::errc() || stopped != end || std::isnan(value)) return invalid(text + ": not a number");
    return value;
}

std::string full_path(const std::string& name) {
    static const std::map<std::string, std::string> shorter{{"fstop", "camera.f_number"},
                                                            {"focus", "camera.focus_distance_m"},
                                                            {"focal_length", "camera.focal_length_mm"},
                                                            {"sensor_width", "camera.sensor_width_mm"},
                                                            {"exposure", "view.exposure"},
                                                            {"lens", "lens.name"}};
    const auto found = shorter.find(name);
    return found == shorter.end() ? name : found->second;
}

Result<std::string> field_text(const App& app, const std::string& name) {
    const std::string path = full_path(name);
    if (const Field* field = find(path)) return field->get(app);
    return text_in(app, json_of(app.state.choice.look), path);
}

namespace {

Result<std::string> text_in(const App& app, const Json& look, const std::string& path) {
    const std::size_t dot = path.find('.');
    const Json* value = look.contains(path) ? &look[path] : nullptr;
    if (dot != std::string::npos && look.contains(path.substr(0, dot))) {
        const Json& section = look[path.substr(0, dot)];
        if (section.contains(path.substr(dot + 1))) value = &section[path.substr(dot + 1)];
    }
    if (!value) return invalid("there is no field " + path);
    if (const FieldRow* row = row_of(app, path)) return row->from_json(value->dump());
    return value->is_string() ? value->get<std::string>() : value->dump();
}

// A camera number is the file's until it is chosen, whatever its value.
bool is_chosen(const CameraChoice& camera, const std::string& path) {
    return (path == "camera.focal_length_mm" && camera.focal_length_mm) ||
           (path == "camera.sensor_width_mm" && camera.sensor_width_mm) ||
           (path == "camera.f_number" && camera.f_number) ||
           (path == "camera.focus_distance_m" && camera.focus_distance_m);
}

const Json& standard_look() {
    static const Json standard = Json::parse(look_to_json(Look{}));
    return standard;
}

}  // namespace

bool is_changed(const App& app, const std::string& name) {
    const std::string path = full_path(name);
    if (const Field* field = find(path)) {
        if (field->standard == "file" && path.starts_with("camera."))
            return is_chosen(app.state.choice.camera, path);
        return !field->standard.empty() && field->get(app) != field->standard;
    }
    const auto standard = text_in(app, standard_look(), path);
    const auto now = text_in(app, json_of(app.state.choice.look), path);
    return standard && now && *standard != *now;
}

Status reset_field(App& app, const std::string& name) {
    const std::string path = full_path(name);
    if (path == "look") {
        app.state.choice.look = {};
        return Done{};
    }
    const Field* field = find(path);
    if (field && field->standard.empty()) return invalid(name + " has no default");
    const auto standard = field ? Result<std::string>(field->standard) : text_in(app, standard_look(), path);
    if (!standard) return standard.error();
    return set_field(app, path, *standard);
}

Status set_field(App& app, const std::string& name, const std::string& text) {
    const std::string path = full_path(name);
    if (const Field* field = find(path)) {
        if (!field->set) return invalid(name + " cannot be set");
        return field->set(app, text);
    }
    std::string json = text;
    if (const FieldRow* row = row_of(app, path)) {
        const auto typed = row->to_json(text);
        if (!typed) return invalid(row->flag + " " + text + ": " + typed.error().message);
        json = *typed;
    }
    auto changed = look_with(app.state.choice.look, path, json);
    if (!changed) return changed.error();
    // A shift implies its focus mode.
    if (path == "lens.focus_shift_mm") changed->lens.focus_mode = FocusMode::Shift;
    if (path == "lens.focus_mode") changed->lens.focus_shift_mm = 0;
    for (const Error& idle : check(*changed, {path}).idle)
        if (idle.field == path) app.notice = idle.message;
    app.state.choice.look = std::move(*changed);
    return Done{};
}

}  // namespace petzval::view
