#include "params.h"

#include "petzval/names.h"
#include "petzval/petzval_c.h"

#include <algorithm>
#include <array>
#include <utility>

namespace petzval::plugin {
namespace {

struct Number {
    const char *name, *label, *hint, *group;
    double Values::*value;
    double usual, least, most, slider_from, slider_to;
};

constexpr double kHuge = 1e9;
constexpr std::array kNumbers{
    Number{"focalLength", "Focal length", "Focal length of the camera that rendered the picture, in mm.",
           "camera", &Values::focal_length_mm, 50, 0.01, 1e5, 10, 200},
    Number{"sensorWidth", "Sensor width", "Width of the sensor that the frame spans, in mm.", "camera",
           &Values::sensor_width_mm, 36, 0.01, 1e5, 5, 70},
    Number{"fStop", "f-stop",
           "Focal length divided by the diameter of the aperture; a smaller number blurs more.", "camera",
           &Values::f_number, 2.8, 0.01, kHuge, 0.7, 22},
    Number{"focusDistance", "Focus distance",
           "Distance of the plane of focus along the optical axis, in metres.", "camera",
           &Values::focus_distance_m, 3, 1e-4, kHuge, 0.1, 50},
    Number{"depthUnit", "Metres per unit", "Length of one unit of the depth channel, in metres.", "depth",
           &Values::depth_unit_m, 1, 1e-9, kHuge, 0.001, 1},
    Number{
        "depthNear", "Depth range: near",
        "Near end of the range, for depth kinds with a range, in units of the scene. 0: none; for normalized "
        "and mist, the camera. For coc-px the radius of 0, in pixels.",
        "depth", &Values::depth_near, 0, -kHuge, kHuge, 0, 10},
    Number{
        "depthFar", "Depth range: far",
        "Far end of the range, for depth kinds with a range, in units of the scene; 0: none. For coc-px the "
        "radius of 1, in pixels.",
        "depth", &Values::depth_far, 0, -kHuge, kHuge, 0, 100},
    Number{"depthFrameOffset", "Depth frame offset",
           "Added to the host's frame number where Depth file has '#': 1001 if frame 0 is depth.1001.exr.",
           "depth", &Values::depth_frame_offset, 0, -kHuge, kHuge, 0, 1001},
};

struct Text {
    const char *name, *label, *hint, *group;
    std::string Values::*value;
    bool is_file;
};
constexpr std::array kTexts{
    Text{"depthFile", "Depth file",
         "EXR, PNG or TIFF with depth; '#' stands for digits of the frame: depth.####.exr.", "depth",
         &Values::depth_file, true},
    Text{"depthChannel", "Depth channel",
         "Channel of the depth file, such as Z; if empty, it is found by its name.", "depth",
         &Values::depth_channel, false},
    Text{name::kLens, "Lens", "Name of a lens, or the path of a lens file; if empty, the lens of the look.",
         "optics", &Values::lens, false},
    Text{"look", "Look", "A look: its JSON, the path of a look file, or a link of the lens lab.", "optics",
         &Values::look, false},
    Text{name::kPreset, "Preset", "Name of a built-in look or of one in your folder of presets; empty: none.",
         "optics", &Values::preset, false},
};

// Words of a menu.
struct Menu {
    const char *name, *label, *hint, *group;
    std::vector<std::string> words;
    int usual = 0;
};

constexpr const char* kOfTheLook = "from the look";

std::vector<std::string> engines() {
    std::vector<std::string> words{kOfTheLook};
    for (int i = 0; petzval_engine_name(i); ++i) words.emplace_back(petzval_engine_name(i));
    return words;
}

template <typename E>
std::vector<std::string> words_of(std::vector<std::string> words = {}) {
    for (const auto& named : names<E>()) words.emplace_back(named.name);
    return words;
}

// A menu whose words are written into a text, which a project keeps: their numbers change between versions.
struct Writer {
    const char *menu, *text, *first, *label, *hint;
    const char* (*word)(int index);
    std::string Values::*value;
};
constexpr std::array kWriters{
    Writer{name::kLensMenu, name::kLens, "choose a lens", "Lens menu", "Writes the name of a lens into Lens.",
           petzval_lens_name, &Values::lens},
    Writer{name::kPresetMenu, name::kPreset, "choose a preset", "Preset menu",
           "Writes the name of a preset into Preset.", petzval_preset_name, &Values::preset},
};

Menu menu_of(const Writer& writer) {
    Menu menu{writer.menu, writer.label, writer.hint, "optics", {writer.first}};
    for (int i = 0; writer.word(i); ++i) menu.words.emplace_back(writer.word(i));
    return menu;
}

bool is_writer(const std::string& menu) {
    return std::any_of(kWriters.begin(), kWriters.end(), [&](const Writer& w) { return menu == w.menu; });
}

// Hosts that pass on the codes of video and of PNG files, as floats of 0 to 1.
bool gives_codes(const std::string& host) { return host == "MLT"; }

// MLT 7.41.0 gives the default of a normalised point as it is declared: its mlt_openfx.c copies defaults into
// values, and multiplies by the frame's size only where a parameter has no value.
bool is_unscaled_middle(const ofx::Point& point) {
    return point.x == 0.5 && point.y == 0.5 && host_name() == "MLT";
}

// Linear comes first, then srgb.
std::vector<std::string> transfers() {
    std::vector<std::string> words{name_of(Transfer::Linear)};
    for (const auto& named : names<Transfer>())
        if (named.value != Transfer::Linear) words.emplace_back(named.name);
    return words;
}

std::vector<Menu> menus() {
    return {{name::kFocusFrom,
             "Focus on",
             "distance: the distance above; point: the depth at the picked point.",
             "camera",
             {"distance", "point"}},
            {"sensorSpans",
             "Sensor spans",
             "The area that the sensor width covers: the frame of the project, or the region of Source.",
             "camera",
             {"project", "Source"}},
            {name::kTransfer, "Source is",
             "linear: light. Others: display codes, which are decoded, blurred as light and encoded again.",
             "camera", transfers(), gives_codes(host_name()) ? 1 : 0},
            {"depthFrom",
             "Depth from",
             "auto: the clip Depth if it is connected, otherwise the depth file.",
             "depth",
             {"auto", "clip", "file", "alpha"}},
            {"depthKind", "Depth kind", "Meaning of the depth channel.", "depth", words_of<DepthKind>()},
            menu_of(kWriters[0]),
            menu_of(kWriters[1]),
            {"engine", "Engine", "Method that computes the blur.", "optics", engines()},
            {"quality", "Quality", "Accuracy of the blur, not its size.", "optics",
             words_of<Quality>({kOfTheLook})}};
}

Properties defined(ofx::ParamSet* params, const char* type, const char* id, const char* label,
                   const char* hint, const char* group) {
    ofx::PropertySet* set = nullptr;
    if (suites().parameter->define(params, type, id, &set) != ofx::kOk) set = nullptr;
    Properties properties(set);
    properties.set(ofx::kLabel, label).set(ofx::param::kHint, hint).set(ofx::param::kScriptName, id);
    if (*group) properties.set(ofx::param::kParent, group);
    return properties;
}

void define_menus(ofx::ParamSet* params) {
    for (const Menu& menu : menus()) {
        Properties p = defined(params, ofx::param::kChoice, menu.name, menu.label, menu.hint, menu.group);
        for (int i = 0; i < int(menu.words.size()); ++i)
            p.set(ofx::param::kChoiceOption, menu.words[std::size_t(i)].c_str(), i);
        p.set(ofx::param::kDefault, menu.usual).set(ofx::param::kAnimates, 0);
        if (is_writer(menu.name)) p.set(ofx::param::kPersistent, 0).set(ofx::param::kEvaluates, 0);
    }
}

void define_point(ofx::ParamSet* params) {
    Properties p = defined(params, ofx::param::kDouble2D, name::kFocusPoint, "Focus point",
                           "The picked point; its depth is the focus distance.", "camera");
    p.set(ofx::param::kDoubleType, ofx::param::kXYAbsolute)
        .set(ofx::param::kCoordinates, ofx::param::kNormalised)
        .set(ofx::param::kDefault, 0.5, 0)
        .set(ofx::param::kDefault, 0.5, 1);
}

template <typename T>
T value_of(ofx::Effect* instance, const char* name, ofx::Time time, T fallback) {
    ofx::Param* param = param_of(instance, name);
    T value = fallback;
    if (!param || suites().parameter->value_at_time(param, time, &value) != ofx::kOk) return fallback;
    return value;
}

// The word chosen in a menu; empty for the first where that leaves the choice to the look.
std::string word_at(ofx::Effect* instance, const std::vector<std::string>& words, const char* name,
                    ofx::Time time) {
    const int chosen = value_of(instance, name, time, 0);
    const std::string& word = words[chosen >= 0 && chosen < int(words.size()) ? std::size_t(chosen) : 0];
    return word == kOfTheLook ? "" : word;
}

// Empty while the menu shows its first entry.
std::string chosen_word(ofx::Effect* instance, const Writer& writer, ofx::Time time) {
    const int chosen = value_of(instance, writer.menu, time, 0);
    const char* word = chosen > 0 ? writer.word(chosen - 1) : nullptr;
    return word ? word : "";
}

}  // namespace

void define_params(ofx::Effect* descriptor) {
    ofx::ParamSet* params = nullptr;
    if (suites().effect->param_set(descriptor, &params) != ofx::kOk || !params) return;
    struct Group {
        const char *name, *label;
    };
    for (const Group& group : {Group{"camera", "Camera"}, {"depth", "Depth"}, {"optics", "Lens and look"}})
        defined(params, ofx::param::kGroup, group.name, group.label, "", "");
    for (const Number& n : kNumbers)
        defined(params, ofx::param::kDouble, n.name, n.label, n.hint, n.group)
            .set(ofx::param::kDefault, n.usual)
            .set(ofx::param::kMin, n.least)
            .set(ofx::param::kMax, n.most)
            .set(ofx::param::kDisplayMin, n.slider_from)
            .set(ofx::param::kDisplayMax, n.slider_to);
    for (const Text& t : kTexts) {
        Properties p = defined(params, ofx::param::kString, t.name, t.label, t.hint, t.group);
        p.set(ofx::param::kDefault, "");
        if (t.is_file) p.set(ofx::param::kStringMode, ofx::param::kFilePath).set(ofx::param::kFileExists, 0);
    }
    define_menus(params);
    define_point(params);
    defined(params, ofx::param::kBoolean, "draft", "Draft while interactive",
            "Use quality draft during interactive changes.", "optics")
        .set(ofx::param::kDefault, 1);
}

ofx::Param* param_of(ofx::Effect* instance, const char* name) {
    ofx::ParamSet* params = nullptr;
    ofx::Param* param = nullptr;
    if (suites().effect->param_set(instance, &params) != ofx::kOk || !params) return nullptr;
    if (suites().parameter->handle(params, name, &param, nullptr) != ofx::kOk) return nullptr;
    return param;
}

Values values_at(ofx::Effect* instance, ofx::Time time) {
    Values v;
    for (const Number& n : kNumbers) v.*n.value = value_of(instance, n.name, time, n.usual);
    for (const Text& t : kTexts) {
        const char* text = value_of<const char*>(instance, t.name, time, nullptr);
        v.*t.value = text ? text : "";
    }
    if (ofx::Param* point = param_of(instance, name::kFocusPoint)) {
        ofx::Point at{};
        if (suites().parameter->value_at_time(point, time, &at.x, &at.y) == ofx::kOk) v.focus_point = at;
        v.focus_is_middle = is_unscaled_middle(v.focus_point);
    }
    v.focus_from =
        value_of(instance, name::kFocusFrom, time, 0) == 1 ? FocusFrom::Point : FocusFrom::Distance;
    v.sensor_spans =
        value_of(instance, "sensorSpans", time, 0) == 1 ? SensorSpans::Source : SensorSpans::Project;
    v.draft_when_interactive = value_of(instance, "draft", time, 1) != 0;
    const int from = value_of(instance, "depthFrom", time, 0);
    v.depth_from = from >= 0 && from <= int(DepthFrom::Alpha) ? DepthFrom(from) : DepthFrom::Auto;
    v.transfer = *parse<Transfer>(word_at(instance, transfers(), name::kTransfer, time));
    v.depth_kind = *parse<DepthKind>(word_at(instance, words_of<DepthKind>(), "depthKind", time));
    v.engine = word_at(instance, engines(), "engine", time);
    v.quality = word_at(instance, words_of<Quality>({kOfTheLook}), "quality", time);
    for (const Writer& writer : kWriters)
        if ((v.*writer.value).empty()) v.*writer.value = chosen_word(instance, writer, time);
    return v;
}

std::string in_labels(std::string message) {
    static constexpr std::pair<std::string_view, std::string_view> kWords[] = {
        {"name one with read.depth_channel or a file with read.depth_file", "name one in Depth channel"},
        {"read.depth_channel", "Depth channel"},
        {"depth.kind", "Depth kind"},
        {"depth.range", "Depth range"},
        {"depth.unit_scale_m", "Metres per unit"},
        {"camera.focal_length_mm", "Focal length"},
        {"camera.sensor_width_mm", "Sensor width"},
        {"camera.f_number", "f-stop"},
        {"camera.focus_distance_m", "Focus distance"},
        {"job.engine", "Engine"},
        {"lens.name", "Lens"}};
    for (const auto& [field, label] : kWords)
        for (std::size_t at = message.find(field); at != std::string::npos;
             at = message.find(field, at + label.size()))
            message.replace(at, field.size(), label);
    return message;
}

bool take_word_of_menu(ofx::Effect* instance, std::string_view menu, ofx::Time time) {
    for (const Writer& writer : kWriters) {
        if (menu != writer.menu) continue;
        const std::string word = chosen_word(instance, writer, time);
        ofx::Param *text = param_of(instance, writer.text), *shown = param_of(instance, writer.menu);
        if (word.empty() || !text || !shown) return true;
        suites().parameter->set_value(text, word.c_str());
        suites().parameter->set_value(shown, 0);
        return true;
    }
    return false;
}

}  // namespace petzval::plugin
