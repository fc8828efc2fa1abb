#include "flags/fields.h"

#include "petzval/defocus.h"

#include "flags/look_rows.h"

#include <map>
#include <string_view>

namespace petzval::cli {
namespace {

using Rows = std::map<std::string, std::string, std::less<>>;

// Flags that are not part of a look: inputs and their meaning.
const Rows& source_flags() {
    static const Rows rows{
        {"depth.kind", "--depth-kind"},
        {"depth.range", "--depth-range"},
        {"depth.unit_scale_m", "--unit-scale"},
        {"points.horizon", "--horizon"},
        {"read.depth_channel", "--depth-channel"},
        {"read.depth_file", "--depth"},
        {"read.layer", "--layer"},
        {"read.layers", "--layers"},
        {"read.motion.layer", "--motion"},
        {"read.motion.scale", "--motion-scale"},
        {"read.max_memory_bytes", "--max-memory"},
        {"read.transfer", "--transfer"},
        {"read.view_name", "--view-name"},
        {"run.frames", "--frames"},
        {"run.keep", "--no-clobber"},
        {"run.missing", "--missing"},
        {"run.output", "-o"},
        {"run.update", "-u"},
        {"scene.camera_at", "--camera-at"},
        {"scene.depth_bits", "--depth-bits"},
        {"scene.depth_blur_px", "--depth-blur"},
        {"scene.depth_is_mean", "--depth-filter mean"},
        {"scene.frame", "--frame"},
        {"scene.height", "--height"},
        {"scene.layers", "--layers"},
        {"scene.lit_in_codes", "--lit-in codes"},
        {"scene.look_at", "--look-at"},
        {"scene.output", "-o"},
        {"scene.overscan_px", "--overscan"},
        {"scene.own_camera", "--scene-camera"},
        {"scene.seed", "--seed"},
        {"scene.truth", "--truth"},
        {"scene.truth_samples", "--samples"},
        {"scene.want_motion", "--motion"},
        {"scene.width", "--width"},
        {"shot.behind", "--plate"},
        {"shot.holdout", "--holdout"},
        {"shot.layers", "--layers"},
        {"shot.lights", "--points"},
        {"shot.mask", "--mask"},
        {"shot.merge", "--merge"},
        {"shot.focus_speed", "--focus-speed"},
        {"shot.overscan_px", "--overscan"},
        {"shot.rack", "--rack"},
        {"shot.region", "--roi"},
        {"shot.temporal", "--temporal"},
        {"shot.track", "--track"},
    };
    return rows;
}

// All others that choose no look.
const Rows& other_flags() {
    static const Rows rows{
        {"atlas.largest_coc_px", "--defocus"},
        {"atlas.zones", "--zones"},
        {"camera.aperture_diameter_mm", "--aperture-diameter"},
        {"camera.f_number", "--fstop"},
        {"camera.focal_length_mm", "--focal-length"},
        {"camera.focus_distance_m", "--focus"},
        {"camera.image_scale", "--breathing"},
        {"camera.sensor_width_mm", "--sensor-width"},
        {"compare.exposure", "--exposure"},
        {"develop.contrast", "--contrast"},
        {"develop.dither", "--no-dither"},
        {"develop.exposure_stops", "--exposure"},
        {"develop.tone", "--tone"},
        {"disc.coc_radius_px", "--defocus"},
        {"disc.columns", "--columns"},
        {"disc.field", "--field"},
        {"disc.side_px", "--side"},
        {"disc.size_px", "--size"},
        {"disc.slices", "--slices"},
        {"farm.folder", "-o"},
        {"focus.at", "--focus-at"},
        {"focus.permissible_radius_px", "--permissible-radius"},
        {"focus.picks", "--at"},
        {"focus.point", "--focus-point"},
        {"job.engine", "--engine"},
        {"job.fill", "--fill"},
        {"job.max_memory_bytes", "--max-memory"},
        {"job.pupil_points", "--pupil-points"},
        {"job.view", "--view"},
        {"lens.kernel_images", "--kernel-image"},
        {"ocio.view", "--ocio"},
        {"ocio.working_space", "--ocio-space"},
        {"report.output", "-o"},
        {"session.device", "--device"},
        {"sheet.columns", "--columns"},
        {"sheet.frames_per_second", "--rate"},
    };
    return rows;
}

const Rows& flags_by_field() {
    static const Rows all = [] {
        Rows rows = other_flags();
        rows.insert(source_flags().begin(), source_flags().end());
        for (const LookRow& row : look_rows()) rows.emplace(row.field, row.flag);
        return rows;
    }();
    return all;
}

// Words instead of a flag that was not typed, and the end of the message.
struct OtherWords {
    std::string words;
    std::function<std::string(const std::string&)> ending;
};
std::map<std::string, OtherWords>& other_words() {
    static std::map<std::string, OtherWords> all;
    return all;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

// End of the word that begins at `start`: letters, and dots between letters.
std::size_t end_of_word(std::string_view text, std::size_t start) {
    std::size_t end = start;
    while (end < text.size() &&
           (is_letter(text[end]) || (text[end] == '.' && end + 1 < text.size() && is_letter(text[end + 1]))))
        ++end;
    return end;
}

// A part of a path is not a field.
bool is_in_path(std::string_view text, std::size_t start, std::size_t end) {
    const auto joins = [](char c) { return c == '/' || c == '-' || c == '.' || (c >= 'A' && c <= 'Z'); };
    return (start > 0 && joins(text[start - 1])) ||
           (end < text.size() && joins(text[end]) && text[end] != '.');
}

}  // namespace

void say_in_place_of(const std::string& flag, const std::string& words,
                     std::function<std::string(const std::string&)> ending) {
    other_words()[flag] = {words, std::move(ending)};
}

std::string in_flags(const std::string& text) {
    std::string said, ending;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = end_of_word(text, at);
        if (end == at) {
            said += text[at++];
            continue;
        }
        const std::string_view word(text.data() + at, end - at);
        const auto row = flags_by_field().find(word);
        // Fields without a section, as quality, are words as well.
        const bool is_field = row != flags_by_field().end() && word.find('.') != std::string_view::npos &&
                              !is_in_path(text, at, end);
        at = end;
        const auto other = is_field ? other_words().find(row->second) : other_words().end();
        if (other != other_words().end()) {
            said += other->second.words;
            if (const std::string more = other->second.ending(text); !more.empty()) ending = "; " + more;
        } else {
            said += is_field ? std::string_view(row->second) : word;
        }
    }
    return said + ending;
}

std::vector<std::string> in_flags(std::vector<std::string> lines) {
    for (std::string& line : lines) line = in_flags(line);
    return lines;
}

std::string spoken(const Error& error) {
    const auto row = flags_by_field().find(error.field);
    const bool begins = row != flags_by_field().end() && error.message.starts_with(error.field);
    std::string said =
        begins ? row->second + in_flags(error.message.substr(error.field.size())) : in_flags(error.message);
    for (const std::string& engine : engine_names())  // a field of one word, which only here is a field
        if (const std::size_t at = said.find(" engine " + engine); at != std::string::npos)
            said.insert(at + 1, "--");
    return said;
}

}  // namespace petzval::cli
