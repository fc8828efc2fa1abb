#include "petzval/output.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/reports/words.h"
#include "petzval/shot.h"
#include "petzval/shots/scene_files.h"

#include "records/record_json.h"

namespace petzval {
namespace {

// "50 mm on a sensor 36 mm wide, 960 x 540 px"
std::string camera_words(const PointSettings& points) {
    return plain(points.focal_length_mm) + " mm on a sensor " + plain(points.sensor_width_mm) + " mm wide, " +
           std::to_string(points.width) + " x " + std::to_string(points.height) + " px";
}

records::Json record_of(const PointsFile& file, std::size_t count) {
    const PointSettings& points = file.settings;
    records::Json record = records::Json::parse(empty_record("scene points"));
    record["input"] = file.set;
    record["output"] = file.output;
    record["parameters"] = {{"width", points.width},
                            {"height", points.height},
                            {"focal_length_mm", points.focal_length_mm},
                            {"sensor_width_mm", points.sensor_width_mm},
                            {"horizon", points.horizon.value_or(0.5)},
                            {"count", count},
                            {"seed", points.seed}};
    return record;
}

}  // namespace

Result<FrameRecord> make_points_file(const PointsFile& file, const FrameLoopHost& host) {
    const Stopwatch total;
    const auto note = [&](const std::string& line) {
        if (host.say) host.say(Say::Note, line);
    };
    FrameRecord made;
    made.output = file.output;
    if (const OutputState there = state_of({file.output}, {}, file.existing); there.is_kept) {
        note(there.why);
        made.state = FrameRecord::State::Kept;
        return made;
    }
    const auto points = make_points(file.set, file.settings);
    if (!points) return points.error();
    const std::string camera = camera_words(file.settings);
    const std::string made_by =
        "petzval scene points " + file.set + ", seed " + std::to_string(file.settings.seed);
    if (Status done = write_text(file.output, lights_text(*points, {made_by, "seen by " + camera})); !done)
        return done.error();
    note("wrote " + file.output + ": " + std::to_string(points->size()) + " points, seen by " + camera);
    records::Json record = record_of(file, points->size());
    made.seconds = total.seconds();
    record["seconds"]["total"] = made.seconds;
    record["peak_memory_bytes"] = peak_memory_bytes();
    made.record = records::as_text(record);
    return made;
}

}  // namespace petzval
