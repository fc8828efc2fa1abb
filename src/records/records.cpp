#include "petzval/records.h"

#include "petzval/look_json.h"
#include "petzval/names.h"
#include "petzval/reports/words.h"
#include "petzval/version.h"

#include "records/record_json.h"

#include <cmath>
#include <sys/resource.h>
#include <utility>

namespace petzval {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;
// A text that no record holds otherwise; as JSON it is  "\u0001infinity"  and is replaced by a number.
const std::string kInfinityMark = "\x01infinity", kMinusInfinityMark = "\x01-infinity";

std::string dumped(const Json& json, int indent = -1) {
    // File names need not be UTF-8: what is not becomes U+FFFD.
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json number_json(double value) {
    if (std::isnan(value)) return nullptr;
    if (std::isinf(value)) return value > 0 ? kInfinityMark : kMinusInfinityMark;
    return value;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

void put_in_words(Json& record, const InWords& in_words) {
    const auto translate = [&](Json& line) {
        if (line.is_string()) line = in_words(line.get<std::string>());
    };
    for (const char* lines : {"detected", "warnings"})
        if (record.contains(lines))
            for (Json& line : record[lines]) translate(line);
    for (const char* line : {"error", "skipped", "made_again"})
        if (record.contains(line)) translate(record[line]);
    if (record.contains("failure")) translate(record["failure"]["message"]);
    if (record.contains("camera") && record["camera"].contains("origins"))
        for (Json& origin : record["camera"]["origins"]) translate(origin);
    if (record.contains("views") && record["views"].is_array())
        for (Json& view : record["views"])
            if (view.is_object()) put_in_words(view, in_words);
}

}  // namespace

std::string record_of_number(double value) { return dumped(number_json(value)); }

std::string record_of_json(const std::string& json) {
    std::string marked;
    bool in_string = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        if (json[i] == '"' && (i == 0 || json[i - 1] != '\\')) in_string = !in_string;
        const bool minus = json.compare(i, 6, "-1e999") == 0;
        if (!in_string && (minus || json.compare(i, 5, "1e999") == 0)) {
            marked += record_of_number(minus ? -HUGE_VAL : HUGE_VAL);
            i += minus ? 5 : 4;
        } else {
            marked += json[i];
        }
    }
    return marked;
}

std::string empty_record(const std::string& verb) {
    return dumped(
        {{"schema", kSchema},
         {"program", "petzval " PETZVAL_VERSION},
         {"verb", verb},
         {"input", nullptr},
         {"output", nullptr},
         {"engine", nullptr},
         {"device", nullptr},
         {"lens", nullptr},
         {"camera", Json::object()},
         {"seconds", {{"read", 0.0}, {"kernels", 0.0}, {"compute", 0.0}, {"write", 0.0}, {"total", 0.0}}},
         {"peak_memory_bytes", 0},
         {"detected", Json::array()},
         {"warnings", Json::array()},
         {"non_finite", {{"colour", 0}, {"depth", 0}}},
         {"stages", Json::array()}});
}

std::string record_of_camera(const FoundCamera& camera, ImageScale image_scale) {
    Json json = Json::object(), origins = Json::object();
    const auto add = [&](const char* key, const std::optional<FoundNumber>& found) {
        json[key] = found ? number_json(found->value) : Json(nullptr);
        if (found) origins[key] = found->origin;
    };
    add("focal_length_mm", camera.focal_length_mm);
    add("sensor_width_mm", camera.sensor_width_mm);
    add("f_number", camera.f_number);
    add("focus_distance_m", camera.focus_distance_m);
    json["image_scale"] = name_of(image_scale);
    json["origins"] = origins;
    return dumped(json);
}

std::string record_of_glare(const Look& look) {
    const GlareAmounts& g = look.glare;
    const bool none = g.bloom == 0 && g.star == 0 && g.ghosts == 0 && g.veil == 0 && !look.vignetting;
    return none ? "null" : dumped(Json::parse(look_to_json(look))["glare"]);
}

std::string record_of_lens(const Look& look, const std::string& description) {
    Json lens = Json::parse(look_to_json(look))["lens"];
    lens["description"] = description;
    lens["aperture_image"] = !look.aperture_image.empty();
    lens["kernel_image"] = !look.kernel_image_far.empty();
    return dumped(lens);
}

std::string record_of_depth(const DepthReport& depth, DepthKind kind) {
    return dumped({{"kind", name_of(kind)},
                   {"nearest_m", number_json(depth.nearest_m)},
                   {"farthest_finite_m", number_json(depth.farthest_finite_m)},
                   {"misses", depth.misses}});
}

std::string record_of_limits(const FocusLimits& limits, double permissible_radius_px) {
    return dumped({{"permissible_radius_px", permissible_radius_px},
                   {"near_m", number_json(limits.near_m)},
                   {"far_m", number_json(limits.far_m)},
                   {"hyperfocal_m", number_json(limits.hyperfocal_m)}});
}

std::string failure_record(const std::string& verb, const Error& error, int exit_code) {
    Json record = Json::parse(empty_record(verb));
    if (verb.empty()) record["verb"] = nullptr;
    record["failure"] = {{"code", name_of(error.code)},
                         {"message", error.message},
                         {"field", error.field.empty() ? Json(nullptr) : Json(error.field)},
                         {"exit_code", exit_code}};
    return dumped(record);
}

std::string finished_record(const std::string& record, int indent, const InWords& in_words) {
    Json json = Json::parse(record);
    if (in_words) put_in_words(json, in_words);
    std::string text = dumped(json, indent) + "\n";
    replace_all(text, "\"\\u0001infinity\"", "1e999");
    replace_all(text, "\"\\u0001-infinity\"", "-1e999");
    return text;
}

std::size_t peak_memory_bytes() {
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-union-access): the C library's own disguise of a plain field
    return std::size_t(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
}

std::string camera_line(const FoundCamera& camera, ImageScale image_scale) {
    const auto number = [](const char* before, const std::optional<FoundNumber>& n, const char* after) {
        return n ? before + plain(n->value) + after + " (" + n->origin + ")"
                 : std::string("no") + before + "number";
    };
    std::string line = "camera: " + number("", camera.focal_length_mm, " mm") + ", " +
                       number("sensor ", camera.sensor_width_mm, " mm") + ", " +
                       number("f/", camera.f_number, "") + ", " +
                       number("focus ", camera.focus_distance_m, " m");
    return line + (image_scale == ImageScale::ThinLens ? ", thin-lens image scale" : "");
}

namespace records {

void add_stages(Json& record, const std::vector<StageTime>& stages, double seconds) {
    Json& sums = record["seconds"];
    double kernels = 0, glare = 0, develop = 0;
    for (const StageTime& one : stages)
        if (one.stage == "kernels")
            kernels += one.seconds;
        else if (one.stage == "develop")
            develop += one.seconds;
        else if (one.is_glare)
            glare += one.seconds;
    sums["kernels"] = kernels;
    sums["glare"] = glare;
    sums["develop"] = develop;
    sums["compute"] = seconds - kernels - glare - develop;
    const auto counted = [](std::uint64_t n) { return n > 0 ? Json(n) : Json(nullptr); };
    for (const StageTime& stage : stages)
        record["stages"].push_back({{"stage", stage.stage},
                                    {"seconds", stage.seconds},
                                    {"bytes", counted(stage.bytes)},
                                    {"multiply_adds", counted(stage.multiply_adds)}});
}

}  // namespace records
}  // namespace petzval
