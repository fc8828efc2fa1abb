// petzval inspect: what was found in a file, and where.
#include "petzval/shots/inspection.h"

#include "console/changes.h"
#include "console/console.h"
#include "console/light_report.h"
#include "console/report.h"
#include "flags/camera.h"
#include "flags/fields.h"
#include "flags/run_flags.h"
#include "frames.h"
#include "input.h"
#include "verbs.h"

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

namespace petzval::cli {
namespace {

struct InspectFlags {
    InputFlags input;
    CameraFlags camera;
    double permissible_radius_px = 1;
    FrameFlags frames;
    RunFlags run;
    bool is_shot = false;
};

// R, G, B, A in this order, then the rest as the file has it: by the alphabet.
void sort_as_read(std::vector<std::string>& names) {
    const auto place = [](const std::string& name) {
        return std::min(std::string("RGBA").find(name), std::size_t(4));
    };
    std::stable_sort(names.begin(), names.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
}

// One line for each layer and type: "ViewLayer. R G B A  (half)".
std::string channel_summary(const PartSummary& part) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<std::string>> names;  // by "layer type"
    for (const std::string& channel : part.channels) {
        const std::size_t space = channel.rfind(' '), dot = channel.rfind('.', space);
        const std::string layer = dot == std::string::npos ? "" : channel.substr(0, dot) + ".";
        const std::string key = layer + '\n' + channel.substr(space + 1);
        if (!names.contains(key)) order.push_back(key);
        names[key].push_back(channel.substr(layer.size(), space - layer.size()));
    }
    std::string text;
    for (const std::string& key : order) {
        const std::size_t split = key.find('\n');
        const std::string layer = key.substr(0, split);
        sort_as_read(names[key]);
        text += "\n    " + layer;
        for (const std::string& name : names[key]) text += (text.back() == ' ' ? "" : " ") + name;
        text += "  (" + key.substr(split + 1) + ")";
    }
    return text;
}

std::string window_text(const Rect& r) {
    return std::to_string(r.width()) + " x " + std::to_string(r.height()) + " at " + std::to_string(r.x0) +
           "," + std::to_string(r.y0);
}

void describe_parts(const Shot& shot, std::ostream& out) {
    for (std::size_t i = 0; i < shot.parts.size(); ++i) {
        const PartSummary& part = shot.parts[i];
        out << "  part " << i << (part.name.empty() ? "" : " \"" + part.name + "\"") << ": " << part.type;
        if (!part.compression.empty()) out << ", " << part.compression;
        if (!part.view.empty()) out << ", view " << part.view;
        out << ", " << window_text(part.data_window) << channel_summary(part) << "\n";
    }
}

void describe_depth(const Shot& shot, const InputFlags& flags, std::ostream& out) {
    if (shot.depth_plane().empty()) {
        out << "depth\n  none\n";
        return;
    }
    out << "depth\n  read as " << name_of(flags.depth_kind.value_or(DepthKind::Planar));
    if (flags.depth_is_coc()) {
        out << "\n";
        return;
    }
    out << ", " << plain(flags.unit_scale_m.value_or(1))
        << " m per unit: " << plain(shot.depth_report.nearest_m) << " m to "
        << plain(shot.depth_report.farthest_finite_m) << " m, " << shot.depth_report.misses << " of "
        << shot.colour.size() << " pixels without depth\n";
}

void describe_camera(const FoundCamera& camera, std::ostream& out) {
    const auto line = [&](const char* what, const std::optional<FoundNumber>& found, const char* unit,
                          const char* flag) {
        out << "  " << what;
        if (found)
            out << plain(found->value) << unit << "  (" << found->origin << ")\n";
        else
            out << "not in the file; give " << flag << "\n";
    };
    out << "camera\n";
    line("focal length    ", camera.focal_length_mm, " mm", "--focal-length");
    line("sensor width    ", camera.sensor_width_mm, " mm", "--sensor-width");
    if (const auto angle = field_of_view_deg(camera)) line("field of view   ", angle, " deg", "");
    line("f-number        ", camera.f_number, "", "--fstop");
    line("focus distance  ", camera.focus_distance_m, " m", "--focus");
}

void describe_list(const char* heading, const std::vector<std::string>& lines, std::ostream& out) {
    if (!lines.empty()) out << heading << "\n";
    for (const std::string& line : lines) out << "  " << one_line(in_flags(line)) << "\n";
}

std::string description(const InspectedFile& inspected, const InspectFlags& all) {
    const auto& [shot, seen] = inspected;
    const InputFlags& flags = all.input;
    std::ostringstream out;
    out << one_line(flags.path) << "\n  display window " << window_text(shot.place.display_window);
    if (shot.place.pixel_aspect != 1) out << ", pixel aspect " << plain(shot.place.pixel_aspect);
    if (shot.display_referred) out << ", display-referred";
    out << "\n";
    describe_parts(shot, out);
    describe_list("detected", detected_in_picture(shot), out);
    describe_depth(shot, flags, out);
    describe_camera(shot.camera, out);
    if (seen.limits) describe_limits(*seen.limits, all.permissible_radius_px, out);
    describe_range(seen.range, out);
    if (shot.non_finite_colour > 0) out << "non-finite colour values\n  " << shot.non_finite_colour << "\n";
    describe_list("warnings", shot.warnings, out);
    describe_list("advice", seen.range.advice, out);
    return printable(out.str());
}

InspectFile file_of(const InspectFlags& flags) {
    InspectFile file{flags.input.source(flags.camera), flags.input.transfer, flags.permissible_radius_px};
    file.source.read.motion.wanted = true;  // to say which there are
    return file;
}

Status inspect(const InspectFlags& flags) {
    const auto seen = inspect_file(file_of(flags), {.cancelled = terminal().cancelled});
    if (!seen) return seen.error();
    return tell(description(*seen, flags), Json::parse(seen->seen.record), flags.run.json);
}

std::string place_of_camera(const FoundCamera& camera) {
    const auto at = position_of(camera);
    return at ? plain(at->x, 4) + "," + plain(at->y, 4) + "," + plain(at->z, 4) : "none";
}

// Values that may change over a shot, in the words of description().
std::vector<Changes::Value> values_of(const InspectedFile& inspected) {
    const Shot& shot = inspected.shot;
    const DynamicRange& range = inspected.seen.range;
    const auto found = [](const std::optional<FoundNumber>& number) {
        return number ? plain(number->value) : std::string("none");
    };
    const bool has_depth = !shot.depth_plane().empty();
    const auto metres = [&](double value) { return has_depth ? plain(value, 4) : std::string("none"); };
    std::size_t channels = 0;
    for (const PartSummary& part : shot.parts) channels += part.channels.size();
    return {{"display window", window_text(shot.place.display_window)},
            {"data window", window_text(shot.place.data_window)},
            {"pixel aspect", plain(shot.place.pixel_aspect)},
            {"channels", std::to_string(channels)},
            {"focal length mm", found(shot.camera.focal_length_mm)},
            {"sensor width mm", found(shot.camera.sensor_width_mm)},
            {"f-number", found(shot.camera.f_number)},
            {"focus m", found(shot.camera.focus_distance_m)},
            {"camera at", place_of_camera(shot.camera)},
            {"nearest m", metres(shot.depth_report.nearest_m)},
            {"farthest m", metres(shot.depth_report.farthest_finite_m)},
            {"misses", std::to_string(shot.depth_report.misses)},
            {"deep samples", std::to_string(shot.deep.sample_count())},
            {"middle light", plain(range.middle, 3)},
            {"brightest", plain(range.brightest, 4)},
            {"not finite", std::to_string(shot.non_finite_colour)}};
}

Status inspect_frames(const InspectFlags& flags) {
    Changes changes;
    FrameWork work = work_of(file_of(flags), terminal(), [&](int frame, const InspectedFile& seen) {
        changes.add(frame, values_of(seen));
    });
    work.finish = [&] {
        return flags.frames.report == "-" ? Status(Done{}) : write_text("-", printable(changes.text()));
    };
    return make_frames(flags.frames, flags.run, std::move(work));
}

void check(InspectFlags& flags, const Verb& verb) {
    require_argument(verb, flags.input.path, "a file");
    flags.run.apply();
    flags.input.check();
    flags.camera.check();
    flags.input.read.need_depth = false;
    flags.is_shot = is_sequence(flags.frames, {flags.input.path, flags.input.read.depth_file}, "", flags.run);
}

}  // namespace

void add_inspect(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "inspect",
                          "show parts, layers, depth and camera numbers of a file, and the ones petzval uses",
                          "petzval inspect beauty.exr\n"
                          "petzval inspect beauty.exr --json - | jq .camera\n"
                          "petzval inspect beauty.####.exr --frames 1001-1100");
    auto flags = std::make_shared<InspectFlags>();
    flags->input.add_to(verb);
    flags->input.add_depth_to(verb);
    flags->input.add_transfer_to(verb);
    flags->camera.add_to(verb, "file");
    add_permissible_radius_to(verb, flags->permissible_radius_px);
    flags->frames.add_to(verb);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, chosen, flags, check,
               [](const auto& given) { return given.is_shot ? inspect_frames(given) : inspect(given); });
}

}  // namespace petzval::cli
