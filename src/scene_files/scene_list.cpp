// The scenes there are, for people and as JSON.
#include "petzval/reports/words.h"
#include "petzval/shots/scene_files.h"

#include "records/record_json.h"

namespace petzval {
namespace {

using records::Json;

std::string padded(const std::string& name, std::size_t columns) {
    return name + std::string(name.size() < columns ? columns - name.size() : 1, ' ');
}

}  // namespace

std::string scene_list_text() {
    constexpr std::size_t kNames = 15, kPointNames = 8;  // columns
    std::string text;
    for (const SceneSummary& scene : scene_list()) {
        const Camera& c = scene.camera;
        text += padded(scene.name, kNames) + scene.purpose + "\n" + std::string(kNames, ' ') +
                plain(c.focal_length_mm) + " mm f/" + plain(c.f_number) + ", focus " +
                plain(c.focus_distance_m) + " m, sensor " + plain(c.sensor_width_mm) + " mm" +
                (scene.frames > 1 ? ", " + std::to_string(scene.frames) + " frames" : "") + "\n";
    }
    text += "points\n";
    for (const PointSetSummary& set : point_set_list())
        text += "  " + padded(set.name, kPointNames) + set.purpose + "\n";
    return text;
}

std::string scene_list_record() {
    Json record = Json::parse(empty_record("scene list"));
    record["scenes"] = Json::array();
    record["points"] = Json::array();
    for (const SceneSummary& scene : scene_list()) {
        const FoundCamera camera = found_camera(scene.camera, "scene " + scene.name);
        record["scenes"].push_back(
            {{"name", scene.name},
             {"purpose", scene.purpose},
             {"frames", scene.frames},
             {"camera", Json::parse(record_of_camera(camera, scene.camera.image_scale))}});
    }
    for (const PointSetSummary& set : point_set_list())
        record["points"].push_back({{"name", set.name}, {"purpose", set.purpose}, {"count", set.count}});
    return records::as_text(record);
}

}  // namespace petzval
