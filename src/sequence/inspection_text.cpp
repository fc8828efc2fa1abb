// The text of an inspection: of one file, and of the frames of a shot.
#include "petzval/names.h"
#include "petzval/reports/words.h"
#include "petzval/shots/inspection.h"

#include <algorithm>
#include <map>
#include <ostream>
#include <sstream>

namespace petzval {
namespace {

using Words = std::function<std::string(const std::string&)>;

std::string in_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

std::string said(const std::string& line, const Words& in_words) { return in_words ? in_words(line) : line; }

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

void describe_depth(const Shot& shot, const DepthSettings& depth, std::ostream& out) {
    if (shot.depth_plane().empty()) {
        out << "depth\n  none\n";
        return;
    }
    out << "depth\n  read as " << name_of(depth.kind);
    if (depth.kind == DepthKind::CocPx) {
        out << "\n";
        return;
    }
    out << ", " << plain(depth.unit_scale_m) << " m per unit: " << plain(shot.depth_report.nearest_m)
        << " m to " << plain(shot.depth_report.farthest_finite_m) << " m, " << shot.depth_report.misses
        << " of " << shot.colour.size() << " pixels without depth\n";
}

void describe_camera(const FoundCamera& camera, const Words& in_words, std::ostream& out) {
    const auto line = [&](const char* what, const std::optional<FoundNumber>& found, const char* unit,
                          const char* field) {
        out << "  " << what;
        if (found)
            out << plain(found->value) << unit << "  (" << said(found->origin, in_words) << ")\n";
        else
            out << "not in the file; give " << said(field, in_words) << "\n";
    };
    out << "camera\n";
    line("focal length    ", camera.focal_length_mm, " mm", "camera.focal_length_mm");
    line("sensor width    ", camera.sensor_width_mm, " mm", "camera.sensor_width_mm");
    if (const auto angle = field_of_view_deg(camera)) line("field of view   ", angle, " deg", "");
    line("f-number        ", camera.f_number, "", "camera.f_number");
    line("focus distance  ", camera.focus_distance_m, " m", "camera.focus_distance_m");
}

void describe_range(const DynamicRange& range, std::ostream& out) {
    out << "light\n  luminance percentiles of lit pixels: p5 (shadow) " << plain(range.shadow, 3)
        << ", p50 (middle) " << plain(range.middle, 3) << ", p90 (diffuse) " << plain(range.diffuse, 3)
        << ", p99.9 (specular) " << plain(range.specular, 3) << "; brightest " << plain(range.brightest, 4)
        << "\n  diffuse over shadow " << plain(range.diffuse_over_shadow_stops, 3)
        << " stops, specular over diffuse " << plain(range.specular_over_diffuse_stops, 3) << " stops\n"
        << (range.comparison.empty() ? "" : "  diffuse is " + range.comparison + "\n") << "  "
        << plain(100 * range.clipped_share, 3) << " % clipped, " << plain(100 * range.black_share, 3)
        << " % without light\n";
}

void describe_limits(const FocusLimits& limits, double permissible_radius_px, std::ostream& out) {
    out << "in focus (blur radius up to " << plain(permissible_radius_px) << " px)\n  "
        << plain(limits.near_m) << " m to " << plain(limits.far_m) << (limits.far_m < 1e30 ? " m" : "")
        << "; hyperfocal distance " << plain(limits.hyperfocal_m) << " m\n";
}

void describe_list(const char* heading, const std::vector<std::string>& lines, const Words& in_words,
                   std::ostream& out) {
    if (!lines.empty()) out << heading << "\n";
    for (const std::string& line : lines) out << "  " << in_one_line(said(line, in_words)) << "\n";
}

std::string place_of_camera(const FoundCamera& camera) {
    const auto at = position_of(camera);
    return at ? plain(at->x, 4) + "," + plain(at->y, 4) + "," + plain(at->z, 4) : "none";
}

std::string padded(const std::string& text, std::size_t width) {
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

}  // namespace

std::string inspection_text(const InspectFile& file, const InspectedFile& inspected, const Words& in_words) {
    const auto& [shot, seen] = inspected;
    std::ostringstream out;
    out << in_one_line(file.source.path) << "\n  display window " << window_text(shot.place.display_window);
    if (shot.place.pixel_aspect != 1) out << ", pixel aspect " << plain(shot.place.pixel_aspect);
    if (shot.display_referred()) out << ", display-referred";
    out << "\n";
    describe_parts(shot, out);
    describe_list("detected", detected_in_picture(shot), in_words, out);
    describe_depth(shot, file.source.depth, out);
    describe_camera(shot.camera, in_words, out);
    if (seen.limits) describe_limits(*seen.limits, file.permissible_radius_px, out);
    describe_range(seen.range, out);
    if (shot.non_finite_colour > 0) out << "non-finite colour values\n  " << shot.non_finite_colour << "\n";
    describe_list("warnings", shot.warnings, in_words, out);
    describe_list("advice", seen.range.advice, in_words, out);
    return out.str();
}

// In the words of inspection_text(). Every frame has the same names in the same order.
std::vector<InspectedShot::Value> InspectedShot::values_of(const InspectedFile& inspected) {
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

void InspectedShot::add(int frame, const InspectedFile& inspected) {
    frames_.push_back(frame);
    rows_.push_back(values_of(inspected));
}

bool InspectedShot::changes(std::size_t column) const {
    return std::any_of(rows_.begin(), rows_.end(),
                       [&](const auto& row) { return row[column].second != rows_.front()[column].second; });
}

std::string InspectedShot::text() const {
    if (rows_.empty()) return "";
    std::string same;
    std::vector<std::string> lines(rows_.size() + 1);
    const auto add_column = [&](const std::string& name, const auto& cell) {
        std::size_t width = name.size();
        for (std::size_t i = 0; i < rows_.size(); ++i) width = std::max(width, std::string(cell(i)).size());
        const std::string gap = lines[0].empty() ? "" : "   ";
        lines[0] += gap + padded(name, width);
        for (std::size_t i = 0; i < rows_.size(); ++i) lines[i + 1] += gap + padded(cell(i), width);
    };
    add_column("frame", [&](std::size_t i) { return std::to_string(frames_[i]); });
    bool any = false;
    for (std::size_t c = 0; c < rows_.front().size(); ++c) {
        const auto& [name, value] = rows_.front()[c];
        if (changes(c))
            add_column(name, [&](std::size_t i) { return rows_[i][c].second; }), any = true;
        else
            same.append("  ").append(name).append(": ").append(value).append("\n");
    }
    std::string text = "the same in all frames\n" + same;
    if (!any) return text + "nothing changes\n";
    text += "what changes\n";
    for (const std::string& line : lines) text += "  " + line + "\n";
    return text;
}

}  // namespace petzval
