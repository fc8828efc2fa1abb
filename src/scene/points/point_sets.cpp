#include "scene/points/point_sets.h"

#include <array>
#include <sstream>

namespace petzval {
namespace scene {
namespace {

const std::array<PointSet, 3>& point_sets() {
    static const std::array<PointSet, 3> sets{glints(), city(), drops()};
    return sets;
}

Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

Status check(const PointSettings& s) {
    const auto in_range = [](int px) { return px >= 1 && px <= 65536; };
    if (!in_range(s.width) || !in_range(s.height))
        return invalid("the picture must be 1 to 65536 px wide and high");
    const auto is_length = [](double mm) { return std::isfinite(mm) && mm >= 1 && mm <= 10000; };
    if (!is_length(s.focal_length_mm)) return invalid("the focal length must be 1 to 10000 mm");
    if (!is_length(s.sensor_width_mm)) return invalid("the sensor width must be 1 to 10000 mm");
    if (s.horizon && !(*s.horizon >= -1 && *s.horizon <= 2))
        return invalid("the horizon must be -1 to 2 picture heights below the top");
    if (s.count < 0 || s.count > 20'000'000) return invalid("the count of points must be 1 to 20000000");
    return Done{};
}

const PointSet* find_points(const std::string& name) {
    for (const PointSet& set : point_sets())
        if (set.summary.name == name) return &set;
    return nullptr;
}

}  // namespace
}  // namespace scene

const std::vector<PointSetSummary>& point_set_list() {
    static const std::vector<PointSetSummary> list = [] {
        std::vector<PointSetSummary> summaries;
        for (const auto& set : scene::point_sets()) summaries.push_back(set.summary);
        return summaries;
    }();
    return list;
}

Result<std::vector<LightPoint>> make_points(const std::string& name, const PointSettings& settings) {
    const scene::PointSet* set = scene::find_points(name);
    if (!set) {
        std::string known;
        for (const PointSetSummary& s : point_set_list()) known += (known.empty() ? "" : ", ") + s.name;
        return scene::invalid("there are no points called " + name + "; there are " + known);
    }
    if (const Status status = scene::check(settings); !status) return status.error();
    if (settings.horizon && !set->summary.has_horizon)
        return scene::invalid("points.horizon has no effect on " + name);
    const int count = settings.count > 0 ? settings.count : set->summary.count;
    std::vector<LightPoint> points = set->make(scene::PointView(settings), count, settings.seed);
    if (int(points.size()) < count && settings.count > 0) {
        std::ostringstream text;
        text << "this picture shows " << points.size() << " points of " << name << "; " << settings.count
             << " were asked for";
        return scene::invalid(text.str());
    }
    return points;
}

}  // namespace petzval
