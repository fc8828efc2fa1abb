#include "fields.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace petzval::cli {
namespace {

struct Row {
    std::string_view field, flag;
};

// Sorted.
constexpr std::array kFlags{
    Row{"camera.f_number", "--fstop"},
    Row{"camera.focal_length_mm", "--focal-length"},
    Row{"camera.focus_distance_m", "--focus"},
    Row{"camera.image_scale", "--image-scale"},
    Row{"camera.sensor_width_mm", "--sensor-width"},
    Row{"compare.exposure", "--exposure"},
    Row{"depth.kind", "--depth-kind"},
    Row{"depth.range", "--depth-range"},
    Row{"depth.unit_scale_m", "--unit-scale"},
    Row{"develop.contrast", "--contrast"},
    Row{"disc.coc_radius_px", "--defocus"},
    Row{"disc.columns", "--columns"},
    Row{"disc.field", "--field"},
    Row{"disc.size_px", "--size"},
    Row{"focus.at", "--focus-at"},
    Row{"focus.falloff", "--focus-falloff"},
    Row{"focus.far_scale", "--far-scale"},
    Row{"focus.max_radius_px", "--max-radius"},
    Row{"focus.near_scale", "--near-scale"},
    Row{"focus.point", "--focus-point"},
    Row{"focus.range_m", "--focus-range"},
    Row{"glare.bloom", "--bloom"},
    Row{"glare.bloom_radius", "--bloom-radius"},
    Row{"glare.ghosts", "--ghosts"},
    Row{"glare.star", "--star"},
    Row{"glare.star_radius", "--star-radius"},
    Row{"glare.threshold", "--glare-threshold"},
    Row{"glare.veil", "--veil"},
    Row{"job.engine", "--engine"},
    Row{"job.max_memory_bytes", "--max-memory"},
    Row{"job.pupil_points", "--pupil-points"},
    Row{"job.view", "--view"},
    Row{"lens.aperture_image", "--aperture-image"},
    Row{"lens.astigmatism", "--astigmatism"},
    Row{"lens.axial_colour", "--axial-colour"},
    Row{"lens.barn_doors", "--barn-doors"},
    Row{"lens.barrel", "--barrel"},
    Row{"lens.blade_curvature", "--blade-curvature"},
    Row{"lens.blade_rotation_deg", "--blade-rotation"},
    Row{"lens.blades", "--blades"},
    Row{"lens.cats_eye", "--cats-eye"},
    Row{"lens.coma", "--coma"},
    Row{"lens.distortion", "--distortion"},
    Row{"lens.dust", "--dust"},
    Row{"lens.focus_shift_mm", "--focus-shift"},
    Row{"lens.iris_open", "--iris-open"},
    Row{"lens.kernel_images", "--kernel-image"},
    Row{"lens.lateral_colour", "--lateral-colour"},
    Row{"lens.onion_rings", "--onion-rings"},
    Row{"lens.scratches", "--scratches"},
    Row{"lens.spherical", "--spherical"},
    Row{"lens.squeeze", "--squeeze"},
    Row{"lens.wavelengths", "--wavelengths"},
    Row{"ocio.view", "--ocio"},
    Row{"ocio.working_space", "--ocio-space"},
    Row{"plate.expand_highlights", "--expand-highlights"},
    Row{"plate.peak", "--highlight-peak"},
    Row{"read.depth_channel", "--depth-channel"},
    Row{"read.depth_file", "--depth"},
    Row{"read.layer", "--layer"},
    Row{"read.view_name", "--view-name"},
    Row{"scene.camera_at", "--camera-at"},
    Row{"scene.depth_bits", "--depth-bits"},
    Row{"scene.depth_blur_px", "--depth-blur"},
    Row{"scene.frame", "--frame"},
    Row{"scene.height", "--height"},
    Row{"scene.look_at", "--look-at"},
    Row{"scene.overscan_px", "--overscan"},
    Row{"scene.truth_samples", "--samples"},
    Row{"scene.width", "--width"},
    Row{"shot.behind", "--behind"},
    Row{"shot.holdout", "--holdout"},
    Row{"shot.lights", "--points"},
    Row{"shot.merge", "--merge"},
    Row{"shot.overscan_px", "--overscan"},
    Row{"sprites.bright_factor", "--bright-factor"},
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

// Where the word that begins at `start` ends: letters, and dots between letters.
std::size_t end_of_word(std::string_view text, std::size_t start) {
    std::size_t end = start;
    while (end < text.size() &&
           (is_letter(text[end]) || (text[end] == '.' && end + 1 < text.size() && is_letter(text[end + 1]))))
        ++end;
    return end;
}

// A part of a path is no field.
bool is_in_path(std::string_view text, std::size_t start, std::size_t end) {
    const auto joins = [](char c) { return c == '/' || c == '-' || c == '.' || (c >= 'A' && c <= 'Z'); };
    return (start > 0 && joins(text[start - 1])) ||
           (end < text.size() && joins(text[end]) && text[end] != '.');
}

}  // namespace

std::string in_flags(const std::string& text) {
    std::string said;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = end_of_word(text, at);
        if (end == at) {
            said += text[at++];
            continue;
        }
        const std::string_view word(text.data() + at, end - at);
        const auto* const row = std::lower_bound(
            kFlags.begin(), kFlags.end(), word, [](const Row& r, std::string_view w) { return r.field < w; });
        const bool is_field = row != kFlags.end() && row->field == word && !is_in_path(text, at, end);
        said += is_field ? row->flag : word;
        at = end;
    }
    return said;
}

std::vector<std::string> in_flags(std::vector<std::string> lines) {
    for (std::string& line : lines) line = in_flags(line);
    return lines;
}

}  // namespace petzval::cli
