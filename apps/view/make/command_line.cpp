#include "command_line.h"

#include "petzval/frames.h"
#include "petzval/look_check.h"
#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/reports/words.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

namespace petzval::view {
namespace {

using Json = nlohmann::ordered_json;
using Words = std::vector<std::string>;

void add_number(Words& words, const char* flag, const std::optional<double>& value) {
    if (value) words.insert(words.end(), {flag, plain(*value, 9)});
}

void add_text(Words& words, const char* flag, const std::string& text) {
    if (!text.empty()) words.insert(words.end(), {flag, text});
}

// The files as typed, unless others were chosen in the window.
Words input_words(const Setup& setup, const InputChoice& input) {
    if (input == input_of(setup.run.source)) return setup.typed_files;
    Words words{input.path};
    add_text(words, "--layer", input.layer);
    add_text(words, "--view-name", input.view_name);
    add_text(words, "--depth", input.depth_file);
    add_text(words, "--depth-channel", input.depth_channel);
    if (input.depth_kind) add_text(words, "--depth-kind", name_of(*input.depth_kind));
    if (input.depth_near && input.depth_far)
        add_text(words, "--depth-range", plain(*input.depth_near, 9) + "," + plain(*input.depth_far, 9));
    if (input.unit_scale_m != 1) add_number(words, "--unit-scale", input.unit_scale_m);
    return words;
}

void add_camera(Words& words, const CameraChoice& camera) {
    add_number(words, "--fstop", camera.f_number);
    if (!camera.f_number) add_number(words, "--aperture-diameter", camera.aperture_diameter_mm);
    add_number(words, "--focus", camera.focus_distance_m);
    add_number(words, "--focal-length", camera.focal_length_mm);
    add_number(words, "--sensor-width", camera.sensor_width_mm);
    if (camera.image_scale != ImageScale::Rendered)
        add_text(words, "--breathing", camera.image_scale == ImageScale::ThinLens ? "on" : "off");
}

// The flags that make the defaults this look, as far as there are flags for it.
void add_look(Words& words, const std::vector<FieldRow>& rows, const Look& look) {
    const Json now = Json::parse(look_to_json(look)), unset = Json::parse(look_to_json(Look{}));
    const LookCheck checked = check(look);
    for (const FieldRow& row : rows) {
        std::string path = "/" + row.path;
        std::replace(path.begin(), path.end(), '.', '/');
        const Json::json_pointer field(path);
        const Json& value = now.at(field);
        if (value == unset.at(field)) continue;
        // --focus-shift implies its mode; a mode without effect would be refused.
        if (row.path == "lens.focus_mode" && value == "shift") continue;
        const auto is_this = [&](const Error& idle) { return idle.field == row.path; };
        if (std::any_of(checked.idle.begin(), checked.idle.end(), is_this)) continue;
        if (row.placeholder.empty())
            words.push_back(row.flag + (value == true ? "" : "=off"));
        else
            words.insert(words.end(), {row.flag, row.from_json(value.dump())});
    }
}

void add_display(Words& words, const Setup& setup, const Choice& choice) {
    if (choice.ocio) {
        add_text(words, "--ocio", setup.run.display_view);
        add_text(words, "--ocio-space", setup.run.display_space);
    } else {
        add_text(words, "--tone", name_of(choice.develop.tone));
        if (choice.develop.contrast != 1) add_number(words, "--contrast", choice.develop.contrast);
    }
    if (choice.develop.exposure_stops != 0) add_number(words, "--exposure", choice.develop.exposure_stops);
}

}  // namespace

std::string command_line(const Setup& setup, const Choice& choice, const std::string& output) {
    Words words{"petzval", "defocus"};
    for (const std::string& word : input_words(setup, choice.input))
        words.push_back(choice.frame ? at_frame(word, *choice.frame) : word);
    words.insert(words.end(), {"-o", output});
    if (setup.session_settings.device != "cpu") add_text(words, "--device", setup.session_settings.device);
    add_camera(words, choice.camera);
    add_look(words, setup.fields, choice.look);
    if (output.ends_with(".png")) add_display(words, setup, choice);
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

}  // namespace petzval::view
