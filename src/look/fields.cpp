#include "look/fields.h"

#include "look/json_values.h"

#include <algorithm>
#include <utility>

namespace petzval::look {
namespace {

// A field that is a member. `at` gives a reference to it, of a constant look and of one that may change.
template <typename At>
Field field(const char* path, At at) {
    return {path, [at](const Look& look) { return to_json(at(look)); },
            [at](Look& look, const Json& json) { return from_json(json, at(look)); }};
}

// Two members that are one range.
template <typename Low, typename High>
Field range(const char* path, Low low, High high) {
    return {path,
            [low, high](const Look& look) {
                return to_json(Range{low(look), high(look)});
            },
            [low, high](Look& look, const Json& json) {
                Range read;
                Status done = from_json(json, read);
                if (done) low(look) = read.first, high(look) = read.second;
                return done;
            }};
}

// A member that is one of two, each with a name.
template <typename At>
Field either(const char* path, const char* off, const char* on, At at) {
    return {path, [=](const Look& look) { return Json(at(look) ? on : off); },
            [=](Look& look, const Json& json) -> Status {
                if (json != on && json != off)
                    return must_be(std::string("\"") + off + "\" or \"" + on + "\"", json);
                at(look) = json == on;
                return Done{};
            }};
}

// The files of kernel images, far and near, as far as there are any.
Field kernel_image(const char* path) {
    return {path,
            [](const Look& look) {
                Json files = Json::array();
                if (!look.kernel_image_far.empty()) files.push_back(look.kernel_image_far);
                if (!look.kernel_image_near.empty()) files.push_back(look.kernel_image_near);
                return files;
            },
            [](Look& look, const Json& json) -> Status {
                const bool texts = json.is_array() && json.size() <= 2 &&
                                   std::all_of(json.begin(), json.end(), [](const Json& j) {
                                       return j.is_string() && !j.get_ref<const std::string&>().empty();
                                   });
                if (!texts) return must_be("a list of file names: none, one, or far and near", json);
                look.kernel_image_far = json.empty() ? "" : json[0].get<std::string>();
                look.kernel_image_near = json.size() < 2 ? "" : json[1].get<std::string>();
                return Done{};
            }};
}

// clang-format off
// A member as a function of a Look or of a const one: no template parameter can name a path of members.
// NOLINTNEXTLINE(cppcoreguidelines-macro-usage, bugprone-macro-parentheses)
#define MEMBER(member) [](auto& look) -> auto& { return look.member; }
// clang-format on

std::vector<Field> lens_fields() {
    return {field("lens.name", MEMBER(lens.name)),
            field("lens.blades", MEMBER(lens.aperture.blades)),
            field("lens.blade_rotation_deg", MEMBER(lens.aperture.rotation_deg)),
            field("lens.blade_curvature", MEMBER(lens.aperture.curvature)),
            field("lens.squeeze", MEMBER(lens.aperture.squeeze)),
            field("lens.iris_open", MEMBER(lens.aperture.round_at_f_number)),
            field("lens.cats_eye", MEMBER(lens.cats_eye)),
            field("lens.barrel", MEMBER(lens.barrel)),
            field("lens.barn_doors", MEMBER(lens.barn_doors)),
            field("lens.aperture_image", MEMBER(aperture_image)),
            kernel_image("lens.kernel_image"),
            field("lens.dust", MEMBER(lens.texture.dust)),
            field("lens.scratches", MEMBER(lens.texture.scratches)),
            field("lens.onion_rings", MEMBER(lens.texture.onion_rings)),
            field("lens.texture_seed", MEMBER(lens.texture.seed)),
            field("lens.focus_mode", MEMBER(lens.focus_mode)),
            field("lens.focus_shift_mm", MEMBER(lens.focus_shift_mm)),
            field("lens.spherical", MEMBER(lens.spherical)),
            field("lens.axial_colour", MEMBER(lens.axial_colour)),
            field("lens.lateral_colour", MEMBER(lens.lateral_colour)),
            field("lens.added_spherical_waves", MEMBER(lens.added.spherical_waves)),
            field("lens.added_at_f_number", MEMBER(lens.added.at_f_number)),
            field("lens.added_axial_colour_mm", MEMBER(lens.added.axial_colour_mm)),
            field("lens.added_field_curvature_mm", MEMBER(lens.added.field_curvature_mm)),
            field("lens.added_lateral_colour_percent", MEMBER(lens.added.lateral_colour_percent)),
            field("lens.coma", MEMBER(lens.coma)),
            field("lens.astigmatism", MEMBER(lens.astigmatism)),
            field("lens.distortion", MEMBER(lens.distortion)),
            field("lens.light", MEMBER(lens.light)),
            field("lens.wavelengths", MEMBER(lens.wavelengths)),
            field("lens.wave", MEMBER(lens.wave))};
}

std::vector<Field> engine_fields() {
    return {field("gather.stage", MEMBER(gather.stage)),
            field("gather.taps", MEMBER(gather.taps)),
            field("gather.tap_offset", MEMBER(gather.tap_offset)),
            field("gather.pixel_size_px", MEMBER(gather.pixel_size_px)),
            field("gather.blurred_px", MEMBER(gather.blurred_px)),
            either("gather.coc", "mean", "extreme", MEMBER(gather.extreme_coc)),
            field("gather.fill", MEMBER(gather.fill_hidden)),
            field("gaussian.style", MEMBER(gaussian.style)),
            field("gaussian.focus_band", MEMBER(gaussian.focus_band)),
            field("gaussian.depth_offset", MEMBER(gaussian.depth_offset)),
            either("gaussian.depth_along", "axis", "ray", MEMBER(gaussian.along_ray)),
            range("gaussian.depth_band_range_m", MEMBER(gaussian.depth_near_m), MEMBER(gaussian.depth_far_m)),
            field("sprites.background", MEMBER(sprites.background)),
            field("sprites.find_points", MEMBER(sprites.find)),
            field("sprites.bright_factor", MEMBER(sprites.bright_factor))};
}

std::vector<Field> light_fields() {
    return {field("glare.bloom", MEMBER(glare.bloom)),
            field("glare.bloom_radius", MEMBER(glare.bloom_radius)),
            field("glare.bloom_threshold", MEMBER(glare.bloom_threshold)),
            field("glare.star", MEMBER(glare.star)),
            field("glare.star_radius", MEMBER(glare.star_radius)),
            field("glare.star_quality", MEMBER(glare.star_quality)),
            field("glare.ghosts", MEMBER(glare.ghosts)),
            field("glare.coating", MEMBER(glare.coating)),
            field("glare.veil", MEMBER(glare.veil)),
            field("glare.threshold", MEMBER(glare.threshold)),
            field("glare.vignetting", MEMBER(vignetting)),
            field("plate.expand_highlights", MEMBER(expand_highlights)),
            field("plate.knee", MEMBER(expansion.knee)),
            field("plate.peak", MEMBER(expansion.peak))};
}

std::vector<Field> all_fields() {
    std::vector<Field> all{field("engine", MEMBER(engine)),
                           field("quality", MEMBER(quality)),
                           field("seed", MEMBER(seed)),
                           field("pupil_points", MEMBER(pupil_points)),
                           field("fill", MEMBER(fill)),
                           field("depth.edges", MEMBER(depth_edges)),
                           range("focus.range_m", MEMBER(coc.focus_near_m), MEMBER(coc.focus_far_m)),
                           field("focus.falloff", MEMBER(coc.focus_falloff)),
                           field("focus.near_scale", MEMBER(coc.near_scale)),
                           field("focus.far_scale", MEMBER(coc.far_scale)),
                           field("focus.max_radius_px", MEMBER(coc.max_radius_px))};
    for (std::vector<Field> more : {lens_fields(), engine_fields(), light_fields()})
        all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    return all;
}

#undef MEMBER

}  // namespace

const std::vector<Field>& fields() {
    static const std::vector<Field> all = all_fields();
    return all;
}

const Field* find_field(const std::string& path) {
    const auto found =
        std::find_if(fields().begin(), fields().end(), [&](const Field& f) { return f.path == path; });
    return found == fields().end() ? nullptr : &*found;
}

}  // namespace petzval::look
