#include "c/report_text.h"

#include <nlohmann/json.hpp>

namespace petzval::c {

std::string report_text(const DefocusReport& report) {
    using Json = nlohmann::ordered_json;
    Json json{
        {"engine", report.engine},
        {"device", report.device},
        {"lens", report.lens},
        {"radius_px",
         {{"farthest_behind", report.largest_radius_px}, {"farthest_in_front", report.smallest_radius_px}}},
        {"seconds", Json::object()},
        {"warnings", report.warnings}};
    if (!report.glare_device.empty()) json["glare_device"] = report.glare_device;
    for (const StageTime& stage : report.stages) json["seconds"][stage.stage] = stage.seconds;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace petzval::c
