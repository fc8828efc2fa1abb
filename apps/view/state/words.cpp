// The library's messages name fields, as camera.f_number; the window shows labels.
#include "fields.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace petzval::view {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

}  // namespace

std::string label_of(const FieldRow& row) {
    std::string label = row.flag.substr(2);
    std::replace(label.begin(), label.end(), '-', ' ');
    return label == "cats eye" ? "cat's eye" : label;
}

std::string plain_words(const App& app, std::string text) {
    static const std::vector<std::pair<std::string, std::string>> words{
        {"name one with read.depth_channel or a file with read.depth_file",
         "choose one below, or a file that has depth"},
        {"job.engine", "engine"},
        {"set session.device gpu", "start the window with --device gpu"},
        {"camera.focal_length_mm", "focal length"},
        {"camera.sensor_width_mm", "sensor width"},
        {"camera.focus_distance_m", "focus"},
        {"camera.f_number", "f-number"},
        {"camera.image_scale", "breathing"},
        {"read.depth_channel", "depth channel"},
        {"read.depth_file", "depth file"},
        {"read.layer", "colour layer"},
        {"read.view_name", "view"},
        {"depth.kind", "depth kind"},
        {"depth.range", "depth range"},
        {"depth.unit_scale_m", "metres per unit"}};
    for (const auto& [field, label] : words) replace_all(text, field, label);
    for (const FieldRow& row : app.setup().fields)
        if (row.path.find('.') != std::string::npos) replace_all(text, row.path, label_of(row));
    return text;
}

}  // namespace petzval::view
