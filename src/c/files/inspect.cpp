#include "c/files/inspect.h"

#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

namespace petzval::c {
namespace {

using Json = nlohmann::ordered_json;

Json window_json(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

// Numbers that the file holds, each with its origin.
Json camera_json(const FoundCamera& camera) {
    Json json = Json::object();
    for (const auto& [name, found] :
         {std::pair("focal_length_mm", &camera.focal_length_mm),
          std::pair("sensor_width_mm", &camera.sensor_width_mm), std::pair("f_number", &camera.f_number),
          std::pair("focus_distance_m", &camera.focus_distance_m)})
        if (*found) json[name] = {{"value", (*found)->value}, {"origin", (*found)->origin}};
    return json;
}

}  // namespace

std::string inspection_text(const Frame& frame) {
    Json parts = Json::array();
    for (const PartSummary& part : frame.parts)
        parts.push_back({{"name", part.name},
                         {"type", part.type},
                         {"view", part.view},
                         {"compression", part.compression},
                         {"data_window", window_json(part.data_window)},
                         {"channels", part.channels}});
    return Json{{"parts", parts},
                {"display_window", window_json(frame.place.display_window)},
                {"data_window", window_json(frame.place.data_window)},
                {"pixel_aspect", frame.place.pixel_aspect},
                {"views", frame.views},
                {"camera", camera_json(frame.camera)},
                {"detected", frame.detected},
                {"warnings", frame.warnings}}
        .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace petzval::c
