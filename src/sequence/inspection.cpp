#include "petzval/shots/inspection.h"

#include "petzval/frames.h"
#include "petzval/records.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/track.h"

#include "records/record_json.h"
#include "sequence/frame_sizes.h"

#include <utility>
#include <vector>

namespace petzval {
namespace {

using records::Json;
using sequence::place_and_size;

Json corners(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

// `window` writes the data window.
Json parts_json(const std::vector<PartSummary>& parts, Json (*window)(const Rect&)) {
    Json all = Json::array();
    for (const PartSummary& part : parts)
        all.push_back({{"name", part.name},
                       {"type", part.type},
                       {"view", part.view},
                       {"compression", part.compression},
                       {"data_window", window(part.data_window)},
                       {"channels", part.channels}});
    return all;
}

Json range_json(const DynamicRange& range) {
    return {{"shadow", range.shadow},
            {"middle", range.middle},
            {"diffuse", range.diffuse},
            {"specular", range.specular},
            {"brightest", range.brightest},
            {"diffuse_over_shadow_stops", range.diffuse_over_shadow_stops},
            {"specular_over_diffuse_stops", range.specular_over_diffuse_stops},
            {"comparison", range.comparison},
            {"clipped_share", range.clipped_share},
            {"black_share", range.black_share},
            {"looks_encoded", range.looks_encoded}};
}

// Numbers that the file holds, each with its origin.
Json numbers_json(const FoundCamera& camera) {
    Json json = Json::object();
    for (const auto& [name, found] :
         {std::pair("focal_length_mm", &camera.focal_length_mm),
          std::pair("sensor_width_mm", &camera.sensor_width_mm), std::pair("f_number", &camera.f_number),
          std::pair("focus_distance_m", &camera.focus_distance_m)})
        if (*found) json[name] = {{"value", (*found)->value}, {"origin", (*found)->origin}};
    return json;
}

std::optional<FocusLimits> limits_of(const Shot& shot, double permissible_radius_px) {
    const auto camera = complete_camera(shot.camera, shot.image_scale);
    if (!camera) return std::nullopt;
    const auto limits = focus_limits(*camera, shot.place.display_window.width(), permissible_radius_px);
    return limits ? std::optional(*limits) : std::nullopt;
}

}  // namespace

Inspection inspection_of(const Shot& shot, DepthKind kind, double permissible_radius_px) {
    Inspection seen{measure_dynamic_range(shot.colour.view(), shot.display_referred()),
                    limits_of(shot, permissible_radius_px),
                    {}};
    Json record = Json::parse(empty_record("inspect"));
    record["input"] = shot.path;
    record["display_window"] = place_and_size(shot.place.display_window);
    record["data_window"] = place_and_size(shot.place.data_window);
    record["pixel_aspect"] = shot.place.pixel_aspect;
    record["display_referred"] = shot.display_referred();
    record["has_alpha"] = shot.has_alpha;
    record["parts"] = parts_json(shot.parts, place_and_size);
    record["depth"] = nullptr;
    if (!shot.depth_plane().empty()) record["depth"] = Json::parse(record_of_depth(shot.depth_report, kind));
    record["deep_samples"] = shot.deep.sample_count();
    record["camera"] = Json::parse(record_of_camera(shot.camera, ImageScale::Rendered));
    record["focus_limits"] = nullptr;
    if (seen.limits)
        record["focus_limits"] = Json::parse(record_of_limits(*seen.limits, permissible_radius_px));
    record["dynamic_range"] = range_json(seen.range);
    record["detected"] = shot.detected;
    record["warnings"] = shot.warnings;
    for (const std::string& line : seen.range.advice) record["warnings"].push_back(line);
    record["non_finite"] = {{"colour", shot.non_finite_colour}, {"depth", shot.depth_report.non_finite}};
    seen.record = records::as_text(record);
    return seen;
}

Result<InspectedFile> inspect_file(const InspectFile& file, const Control& control) {
    const Stopwatch watch;
    auto shot = read_shot(file.source, control);
    if (!shot) return shot.error();
    if (file.transfer && !shot->display_referred())
        return Error{ErrorCode::InvalidArgument,
                     "read.transfer is for whole numbers, such as those of PNG; " + file.source.path +
                         " does not hold them"};
    Inspection seen = inspection_of(*shot, file.source.depth.kind, file.permissible_radius_px);
    Json record = Json::parse(seen.record);
    record["input"] = file.source.path;
    record["seconds"]["read"] = record["seconds"]["total"] = watch.seconds();
    record["peak_memory_bytes"] = peak_memory_bytes();
    seen.record = records::as_text(record);
    return InspectedFile{std::move(*shot), std::move(seen)};
}

FrameWork work_of(const InspectFile& file, const FrameLoopHost& host,
                  const std::function<void(int frame, const InspectedFile&)>& inspected) {
    const Control control{.cancelled = host.cancelled};
    FrameWork work;
    work.input = file.source.path;
    const auto of_frame = [file](int frame) {
        InspectFile of = file;
        of.source = at_frame(std::move(of.source), frame);
        return of;
    };
    work.files = [of_frame](int frame) -> Result<FrameWork::Files> {
        return FrameWork::Files{files_of(of_frame(frame).source), {}};
    };
    work.make = [of_frame, control, inspected](int frame, bool) -> Result<FrameRecord> {
        const auto file_of_frame = inspect_file(of_frame(frame), control);
        if (!file_of_frame) return file_of_frame.error();
        inspected(frame, *file_of_frame);
        return frame_record(file_of_frame->seen.record);
    };
    return work;
}

std::string header_json(const Frame& header) {
    return records::as_text({{"parts", parts_json(header.parts, corners)},
                             {"display_window", corners(header.place.display_window)},
                             {"data_window", corners(header.place.data_window)},
                             {"pixel_aspect", header.place.pixel_aspect},
                             {"views", header.views},
                             {"camera", numbers_json(header.camera)},
                             {"detected", header.detected},
                             {"warnings", header.warnings}});
}

}  // namespace petzval
