#include "petzval/frame_loop.h"

#include "records/record_json.h"

#include <cmath>

namespace petzval {

using records::Json;

FrameRecord frame_record(const std::string& record) {
    const Json json = Json::parse(record);
    FrameRecord of;
    const auto text = [&](const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    const auto number = [&](const char* key) -> std::optional<double> {
        const Json camera = json.value("camera", Json::object());
        if (!camera.contains(key) || camera[key].is_null()) return std::nullopt;
        return camera[key].is_number() ? camera[key].get<double>() : HUGE_VAL;
    };
    if (json.contains("skipped")) of.state = FrameRecord::State::Kept;
    of.why = of.state == FrameRecord::State::Kept ? text("skipped") : text("made_again");
    of.input = text("input"), of.output = text("output");
    of.focus_m = number("focus_distance_m"), of.f_number = number("f_number");
    for (const Json& line : json.value("warnings", Json::array()))
        of.warnings.push_back(line.get<std::string>());
    of.record = record;
    return of;
}

}  // namespace petzval
