#include "report.h"

#include "petzval/look_json.h"
#include "petzval/version.h"

#include "fields.h"
#include "output.h"

#include <cmath>
#include <sys/resource.h>
#include <utility>

namespace petzval::cli {
namespace {

constexpr int kSchema = 1;
// A text that no report holds otherwise; as JSON it is  "\u0001infinity"  and is replaced by a number.
const std::string kInfinityMark = "\x01infinity", kMinusInfinityMark = "\x01-infinity";

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

}  // namespace

Json new_report(const std::string& verb) {
    return {{"schema", kSchema},
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
            {"stages", Json::array()}};
}

Json number(double value) {
    if (std::isnan(value)) return nullptr;
    if (std::isinf(value)) return value > 0 ? kInfinityMark : kMinusInfinityMark;
    return value;
}

Json json_of(const std::string& text) {
    std::string marked;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) in_string = !in_string;
        const bool minus = text.compare(i, 6, "-1e999") == 0;
        if (!in_string && (minus || text.compare(i, 5, "1e999") == 0)) {
            marked += Json(minus ? kMinusInfinityMark : kInfinityMark).dump();
            i += minus ? 5 : 4;
        } else {
            marked += text[i];
        }
    }
    return Json::parse(marked);
}

Json camera_json(const FoundCamera& camera, ImageScale image_scale) {
    Json json = Json::object(), origins = Json::object();
    const auto add = [&](const char* key, const std::optional<FoundNumber>& found) {
        json[key] = found ? number(found->value) : Json(nullptr);
        if (found) origins[key] = in_flags(found->origin);
    };
    add("focal_length_mm", camera.focal_length_mm);
    add("sensor_width_mm", camera.sensor_width_mm);
    add("f_number", camera.f_number);
    add("focus_distance_m", camera.focus_distance_m);
    json["image_scale"] = name_of(image_scale);
    json["origins"] = origins;
    return json;
}

Json look_json(const Look& look) { return Json::parse(look_to_json(look)); }

Json glare_json(const Look& look) {
    const GlareAmounts& g = look.glare;
    const bool none = g.bloom == 0 && g.star == 0 && g.ghosts == 0 && g.veil == 0 && !look.vignetting;
    return none ? Json(nullptr) : look_json(look)["glare"];
}

Json lens_json(const Look& look, const std::string& description) {
    Json lens = look_json(look)["lens"];
    lens["description"] = description;
    lens["aperture_image"] = !look.aperture_image.empty();
    lens["kernel_image"] = !look.kernel_image_far.empty();
    return lens;
}

Json window_json(const Rect& window) {
    return {{"x", window.x0}, {"y", window.y0}, {"width", window.width()}, {"height", window.height()}};
}

void add_stages(Json& report, const std::vector<StageTime>& stages, double seconds) {
    double rest = seconds;
    Json& sums = report["seconds"];
    for (const auto& [stage, sum] :
         {std::pair("kernels", "kernels"), {"light", "glare"}, {"develop", "develop"}}) {
        sums[sum] = 0.0;
        for (const StageTime& one : stages)
            if (one.stage == stage) sums[sum] = sums[sum].get<double>() + one.seconds, rest -= one.seconds;
    }
    sums["compute"] = rest;
    const auto counted = [](std::uint64_t n) { return n > 0 ? Json(n) : Json(nullptr); };
    for (const StageTime& stage : stages)
        report["stages"].push_back({{"stage", stage.stage},
                                    {"seconds", stage.seconds},
                                    {"bytes", counted(stage.bytes)},
                                    {"multiply_adds", counted(stage.multiply_adds)}});
}

Json part_json(const PartSummary& part) {
    return {{"name", part.name},
            {"type", part.type},
            {"view", part.view},
            {"compression", part.compression},
            {"data_window", window_json(part.data_window)},
            {"channels", part.channels}};
}

Json depth_json(const DepthReport& depth, DepthKind kind) {
    return {{"kind", name_of(kind)},
            {"nearest_m", number(depth.nearest_m)},
            {"farthest_finite_m", number(depth.farthest_finite_m)},
            {"misses", depth.misses}};
}

std::size_t peak_memory_bytes() {
    struct rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-union-access): the C library's own disguise of a plain field
    return std::size_t(usage.ru_maxrss) * 1024;  // Linux counts kilobytes
}

std::string report_text(Json report, int indent) {
    for (const char* lines : {"detected", "warnings"})
        if (report.contains(lines))
            for (Json& line : report[lines]) line = in_flags(line.get<std::string>());
    for (const char* line : {"error", "skipped", "made_again"})
        if (report.contains(line)) report[line] = in_flags(report[line].get<std::string>());
    // File names need not be UTF-8: what is not becomes U+FFFD.
    std::string text = report.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
    replace_all(text, "\"\\u0001infinity\"", "1e999");
    replace_all(text, "\"\\u0001-infinity\"", "-1e999");
    return text;
}

Status write_report(Json report, const std::string& path) {
    return write_text(path, report_text(std::move(report)));
}

Status tell(const std::string& text, Json report, const std::string& json) {
    if (json != "-")
        if (Status said = write_text("-", text); !said) return said;
    return json.empty() ? Status(Done{}) : write_report(std::move(report), json);
}

}  // namespace petzval::cli
