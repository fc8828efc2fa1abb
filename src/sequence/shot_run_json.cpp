// Settings of a run as JSON, for hosts that have no C++.
#include "petzval/frames.h"
#include "petzval/look_file.h"
#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/shot_run.h"

#include "records/record_json.h"

#include <cmath>
#include <limits>

namespace petzval {
namespace {

using records::Json;

// Message about a wrong value; thrown and caught only in this file.
struct WrongValue {
    std::string what;
};

double number_in(const Json& value) {
    if (value.is_string() && value.get<std::string>() == "inf")
        return std::numeric_limits<double>::infinity();
    if (!value.is_number()) throw WrongValue{"is not a number"};
    return value.get<double>();
}

int whole_in(const Json& value) {
    const double number = number_in(value);
    if (!(std::abs(number) < 2147483648.0) || number != std::floor(number))
        throw WrongValue{"is not a whole number"};
    return int(number);
}

std::size_t count_in(const Json& value) {
    const double number = number_in(value);
    if (!(number >= 0 && number < 1e18)) throw WrongValue{"is not a whole number of 0 or more"};
    return std::size_t(number);
}

std::string text_in(const Json& value) {
    if (!value.is_string()) throw WrongValue{"is not a string"};
    return value.get<std::string>();
}

std::vector<std::string> texts_in(const Json& value) {
    if (!value.is_array()) throw WrongValue{"is not a list of strings"};
    std::vector<std::string> texts;
    for (const Json& one : value) texts.push_back(text_in(one));
    return texts;
}

std::vector<double> numbers_in(const Json& value, std::size_t count) {
    if (!value.is_array() || value.size() != count)
        throw WrongValue{"is not a list of " + std::to_string(count) + " numbers"};
    std::vector<double> numbers;
    for (const Json& one : value) numbers.push_back(number_in(one));
    return numbers;
}

template <typename E>
E choice_in(const Json& value, const std::vector<std::pair<std::string, E>>& table) {
    const std::string text = text_in(value);
    std::string known;
    for (const auto& [name, choice] : table) {
        if (name == text) return choice;
        known += (known.empty() ? "" : ", ") + name;
    }
    throw WrongValue{"is not one of " + known};
}

template <typename E>
E named_in(const Json& value) {
    std::vector<std::pair<std::string, E>> table;
    for (const Named<E>& known : names<E>()) table.emplace_back(known.name, known.value);
    return choice_in(value, table);
}

// A file, or the fields themselves, which need not say the version.
Look look_in(const Json& value) {
    if (!value.is_string() && !value.is_object()) throw WrongValue{"is neither a file nor an object"};
    Json fields = value;
    if (value.is_object() && !value.contains("petzval_look")) fields["petzval_look"] = kLookVersion;
    auto look = value.is_string() ? read_look(value.get<std::string>()) : look_from_json(fields.dump());
    if (!look) throw WrongValue{": " + look.error().message};
    return std::move(*look);
}

using Take = void (*)(const Json&, ShotRunSettings&);

struct Key {
    const char* name;
    Take take;
};

constexpr Key kCameraKeys[] = {
    {"focal_length_mm",
     [](const Json& v, ShotRunSettings& s) { s.source.camera.focal_length_mm = number_in(v); }},
    {"sensor_width_mm",
     [](const Json& v, ShotRunSettings& s) { s.source.camera.sensor_width_mm = number_in(v); }},
    {"f_number",
     [](const Json& v, ShotRunSettings& s) {
         s.source.camera.wide_open = v == "open";
         if (v != "open") s.source.camera.f_number = number_in(v);
     }},
    {"focus_distance_m",
     [](const Json& v, ShotRunSettings& s) { s.source.camera.focus_distance_m = number_in(v); }},
    {"aperture_diameter_mm",
     [](const Json& v, ShotRunSettings& s) { s.source.camera.aperture_diameter_mm = number_in(v); }},
    {"image_scale",
     [](const Json& v, ShotRunSettings& s) { s.source.camera.image_scale = named_in<ImageScale>(v); }}};

// The value of each key of an object. Throws WrongValue with the key before it.
template <std::size_t N>
void take_all(const Json& json, const Key (&keys)[N], const std::string& before, ShotRunSettings& settings) {
    if (!json.is_object()) throw WrongValue{before + "is not an object"};
    for (const auto& [name, value] : json.items()) {
        const Key* found = nullptr;
        for (const Key& key : keys)
            if (name == key.name) found = &key;
        if (!found) throw WrongValue{before + name + " is not known"};
        try {
            found->take(value, settings);
        } catch (const WrongValue& wrong) {
            const bool is_own = wrong.what.starts_with(":") || wrong.what.starts_with("is ");
            throw WrongValue{is_own ? before + name + (wrong.what[0] == ':' ? "" : " ") + wrong.what
                                    : wrong.what};
        }
    }
}

constexpr Key kKeys[] = {
    {"input", [](const Json& v, ShotRunSettings& s) { s.source.path = text_in(v); }},
    {"output", [](const Json& v, ShotRunSettings& s) { s.output = text_in(v); }},
    {"frames",
     [](const Json& v, ShotRunSettings& s) {
         auto frames = parse_frames(text_in(v));
         if (!frames) throw WrongValue{": " + frames.error().message};
         s.frames = std::move(*frames);
     }},
    {"look", [](const Json& v, ShotRunSettings& s) { s.look = look_in(v); }},
    {"camera", [](const Json& v, ShotRunSettings& s) { take_all(v, kCameraKeys, "camera.", s); }},
    {"focus_at",
     [](const Json& v, ShotRunSettings& s) {
         const auto pixel = numbers_in(v, 2);
         s.focus_pixel = PixelPosition{int(pixel[0]), int(pixel[1])};
     }},
    {"focus_point",
     [](const Json& v, ShotRunSettings& s) {
         const auto point = numbers_in(v, 3);
         s.focus_point = WorldPoint{point[0], point[1], point[2]};
     }},
    {"depth", [](const Json& v, ShotRunSettings& s) { s.source.read.depth_file = text_in(v); }},
    {"depth_channel", [](const Json& v, ShotRunSettings& s) { s.source.read.depth_channel = text_in(v); }},
    {"depth_kind",
     [](const Json& v, ShotRunSettings& s) {
         s.source.depth.kind = named_in<DepthKind>(v), s.source.depth_kind_given = true;
     }},
    {"depth_range",
     [](const Json& v, ShotRunSettings& s) {
         const auto range = numbers_in(v, 2);
         s.source.depth.range_near = range[0], s.source.depth.range_far = range[1];
     }},
    {"unit_scale_m", [](const Json& v, ShotRunSettings& s) { s.source.depth.unit_scale_m = number_in(v); }},
    {"layer", [](const Json& v, ShotRunSettings& s) { s.source.read.layer = text_in(v); }},
    {"layers", [](const Json& v, ShotRunSettings& s) { s.source.read.layers = texts_in(v); }},
    {"view_name", [](const Json& v, ShotRunSettings& s) { s.source.read.view_name = text_in(v); }},
    {"behind", [](const Json& v, ShotRunSettings& s) { s.source.behind = text_in(v); }},
    {"holdout", [](const Json& v, ShotRunSettings& s) { s.source.holdout = text_in(v); }},
    {"mask", [](const Json& v, ShotRunSettings& s) { s.source.mask = text_in(v); }},
    {"merge", [](const Json& v, ShotRunSettings& s) { s.source.merge = texts_in(v); }},
    {"lights", [](const Json& v, ShotRunSettings& s) { s.source.lights = text_in(v); }},
    {"track", [](const Json& v, ShotRunSettings& s) { s.track_file = text_in(v); }},
    {"rack", [](const Json& v, ShotRunSettings& s) { s.rack = texts_in(v); }},
    {"focus_speed", [](const Json& v, ShotRunSettings& s) { s.focus_speed = number_in(v); }},
    {"temporal", [](const Json& v, ShotRunSettings& s) { s.temporal = whole_in(v); }},
    {"motion",
     [](const Json& v, ShotRunSettings& s) {
         const MotionReading motion = motion_reading(text_in(v));
         s.motion.from = motion.from;
         s.motion.wanted = motion.wanted;
         s.motion.layer = motion.layer;
     }},
    {"motion_scale",
     [](const Json& v, ShotRunSettings& s) {
         const auto scale = numbers_in(v, 2);
         if (scale[0] == 0 || scale[1] == 0) throw WrongValue{"is not two numbers other than 0"};
         s.motion.scale_x = scale[0];
         s.motion.scale_y = scale[1];
     }},
    {"existing",
     [](const Json& v, ShotRunSettings& s) {
         s.existing = choice_in<ExistingOutputs>(v, {{"replace", ExistingOutputs::Replace},
                                                     {"keep", ExistingOutputs::Keep},
                                                     {"update", ExistingOutputs::Update}});
     }},
    {"missing",
     [](const Json& v, ShotRunSettings& s) {
         s.missing = choice_in<MissingFiles>(
             v, {{"fail", MissingFiles::Fail}, {"skip", MissingFiles::Skip}, {"black", MissingFiles::Black}});
     }},
    {"retries", [](const Json& v, ShotRunSettings& s) { s.retries = whole_in(v); }},
    {"record", [](const Json& v, ShotRunSettings& s) { s.record_file = text_in(v); }},
    {"report", [](const Json& v, ShotRunSettings& s) { s.report_file = text_in(v); }},
    {"view", [](const Json& v, ShotRunSettings& s) { s.view = choice_in(v, shot_views()); }},
    {"region",
     [](const Json& v, ShotRunSettings& s) {
         const auto ends = numbers_in(v, 4);
         if (!(ends[0] < ends[2] && ends[1] < ends[3])) throw WrongValue{"is not x0, y0, x1, y1 with x0 < x1 and y0 < y1"};
         s.region = Rect{int(ends[0]), int(ends[1]), int(ends[2]), int(ends[3])};
     }},
    {"overscan",
     [](const Json& v, ShotRunSettings& s) {
         s.overscan_px = v.is_string() ? choice_in<int>(v, {{"fit", kOverscanWithinFrame},
                                                            {"auto", kOverscanAutomatic},
                                                            {"off", kOverscanOff}})
                                       : whole_in(v);
     }},
    {"exposure", [](const Json& v, ShotRunSettings& s) { s.display.exposure_stops = number_in(v); }},
    {"contrast", [](const Json& v, ShotRunSettings& s) { s.display.contrast = number_in(v); }},
    {"tone", [](const Json& v, ShotRunSettings& s) { s.display.tone = named_in<ToneCurve>(v); }},
    {"threads", [](const Json& v, ShotRunSettings& s) { s.source.read.threads = whole_in(v); }},
    {"max_memory_bytes",
     [](const Json& v, ShotRunSettings& s) { s.source.read.max_memory_bytes = count_in(v); }}};

Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

}  // namespace

Result<ShotRunSettings> shot_run_from_json(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) return invalid("settings of a shot run: not JSON");
    ShotRunSettings settings;
    settings.motion = motion_reading("");
    try {
        take_all(json, kKeys, "", settings);
    } catch (const WrongValue& wrong) {
        return invalid("settings of a shot run: " + wrong.what);
    }
    if (settings.source.path.empty()) return invalid("settings of a shot run: input is missing");
    if (settings.output.empty()) return invalid("settings of a shot run: output is missing");
    if (const auto kind = kind_of_output(settings.output); !kind) return kind.error();
    if (Status fine = check(settings.source); !fine) return fine.error();
    return settings;
}

}  // namespace petzval
