// Finds choices without effect: one table of pairs, checked for every chosen field.
#include "petzval/look_check.h"
#include "petzval/names.h"

#include "look/fields.h"

#include <algorithm>
#include <functional>

namespace petzval {
namespace {

// Why those fields change nothing in this look, as "without lens.blades"; nothing where they do.
struct Rule {
    std::vector<std::string> fields;
    std::function<std::string(const Look&)> why_idle;
};
using Rules = std::vector<Rule>;

std::string unless(bool has_effect, const std::string& why) { return has_effect ? "" : why; }

std::string with_engine(const Look& look) { return "with engine " + look.engine; }

bool is_over_gaussian(const Look& look) {
    return look.engine == "sprites" && look.sprites.background == SpriteBackground::Gaussian;
}
bool uses_gather(const Look& look) {
    return look.engine == "gather" || (look.engine == "sprites" && !is_over_gaussian(look));
}
bool uses_gaussian(const Look& look) { return look.engine == "gaussian" || is_over_gaussian(look); }
bool is_published_stage(const Look& look) {
    return look.engine == "gather" && look.gather.stage != GatherStage::Final;
}
bool is_wgld(const Look& look) { return uses_gaussian(look) && look.gaussian.style == GaussianStyle::Wgld; }
bool has_images(const Look& look) { return !look.kernel_image_far.empty() || look.lens.kernel_images.far; }
bool has_texture(const Look& look) {
    const PupilTexture& t = look.lens.texture;
    return t.dust > 0 || t.scratches > 0 || t.onion_rings > 0;
}

// Why no disc of this look shows what the lens is like.
std::string why_blind(const Look& look) {
    if (look.engine == "gaussian") return with_engine(look) + ", whose blur is always round";
    if (is_published_stage(look))
        return std::string("with gather.stage ") + name_of(look.gather.stage) +
               ", which draws round discs only";
    return "";
}

Rules rules_of_engines() {
    return {
        {{"quality"},
         [](const Look& l) {
             return unless(l.engine != "gaussian" && l.engine != "reference" && !is_published_stage(l),
                           l.engine == "gather" ? std::string("with gather.stage ") + name_of(l.gather.stage)
                                                : with_engine(l));
         }},
        {{"seed", "pupil_points"},
         [](const Look& l) {
             return unless(l.engine == "reference", with_engine(l) + "; it is for engine reference");
         }},
        {{"focus.falloff"},
         [](const Look& l) {
             return unless(l.coc.focus_far_m > 0, "without focus.range_m, such as focus.range_m 1.8m,3m");
         }},
        {{"depth.edges", "focus.range_m", "focus.falloff", "focus.near_scale", "focus.far_scale",
          "focus.max_radius_px"},
         [](const Look& l) {
             return unless(!is_published_stage(l) || l.gather.stage != GatherStage::Prefilter,
                           "with gather.stage prefilter, which uses no radius");
         }},
        {{"gaussian.style", "gaussian.focus_band"},
         [](const Look& l) {
             return unless(uses_gaussian(l), "without engine gaussian, or sprites over it");
         }},
        {{"gaussian.depth_offset", "gaussian.depth_along", "gaussian.depth_band_range_m"},
         [](const Look& l) { return unless(is_wgld(l), "without gaussian.style wgld of engine gaussian"); }},
        {{"sprites.background"},
         [](const Look& l) {
             return unless(l.engine == "sprites", with_engine(l) + "; it is for engine sprites");
         }},
        {{"sprites.find_points", "sprites.bright_factor"},
         [](const Look& l) {
             return unless(l.engine == "sprites" || (l.engine == "gather" && !is_published_stage(l)),
                           "without engine gather itself, or sprites");
         }},
        {{"sprites.bright_factor"},
         [](const Look& l) { return unless(l.sprites.find, "with sprites.find_points off"); }},
    };
}

Rules rules_of_gather() {
    return {
        {{"gather.stage"},
         [](const Look& l) {
             return unless(l.engine == "gather", with_engine(l) + "; it is for engine gather");
         }},
        {{"gather.taps", "gather.coc"},
         [](const Look& l) {
             return unless(is_published_stage(l), "without gather.stage of engine gather");
         }},
        {{"gather.taps"},
         [](const Look& l) {
             return unless(l.gather.stage != GatherStage::Coc && l.gather.stage != GatherStage::Prefilter,
                           std::string("with gather.stage ") + name_of(l.gather.stage) +
                               ", which comes before the disc");
         }},
        {{"gather.coc"},
         [](const Look& l) {
             return unless(l.gather.stage != GatherStage::Coc && l.gather.stage != GatherStage::Prefilter &&
                               l.gather.stage != GatherStage::Disc && l.gather.stage != GatherStage::DiscBlur,
                           std::string("with gather.stage ") + name_of(l.gather.stage) +
                               ", which does not use the radius of 2 x 2 pixels");
         }},
        {{"gather.tap_offset"},
         [](const Look& l) {
             return unless(
                 l.engine == "gather" &&
                     (l.gather.stage == GatherStage::DiscBlur || l.gather.stage == GatherStage::Blur ||
                      l.gather.stage == GatherStage::Combine || l.gather.stage == GatherStage::Cure),
                 "without gather.stage disc-blur, blur, combine or cure");
         }},
        {{"gather.pixel_size_px", "gather.blurred_px"},
         [](const Look& l) {
             return unless(l.engine == "gather" && (l.gather.stage == GatherStage::Combine ||
                                                    l.gather.stage == GatherStage::Cure),
                           "without gather.stage combine or cure");
         }},
        {{"gather.fill"},
         [](const Look& l) {
             return unless(uses_gather(l) && !is_published_stage(l),
                           "without engine gather itself, or sprites over it");
         }},
        {{"gather.fill"}, [](const Look& l) { return unless(l.fill != Fill::Off, "with fill off"); }},
        {{"fill"},
         [](const Look& l) {
             return unless(l.engine == "scatter" || (uses_gather(l) && !is_published_stage(l)) ||
                               (uses_gaussian(l) && l.gaussian.style == GaussianStyle::Layered &&
                                (l.engine == "sprites" || l.gaussian.view == GaussianView::Result)),
                           is_published_stage(l) ? "without engine gather itself"
                           : uses_gaussian(l)    ? "without gaussian.style layered itself"
                                                 : with_engine(l) + ", which adds nothing");
         }},
        {{"fill"},
         [](const Look& l) {
             return unless(!uses_gather(l) || l.gather.fill_hidden, "with gather.fill off");
         }},
    };
}

bool is_of_lines(LightSpectrum light) {
    return light != LightSpectrum::Daylight && light != LightSpectrum::Led;
}
bool blurs_the_axis(const AddedAberrations& added) {
    return added.spherical_waves != 0 || added.axial_colour_mm != 0;
}
bool adds_colour(const AddedAberrations& added) {
    return added.axial_colour_mm != 0 || added.lateral_colour_percent != 0;
}

constexpr const char* kStandIn = "with lens.kernel_image, which replaces the lens";

// Fields that change discs only, never glare.
const std::vector<std::string> kTexture{"lens.aperture_image", "lens.dust", "lens.scratches",
                                        "lens.onion_rings", "lens.texture_seed"};
const std::vector<std::string> kCharacter{"lens.focus_mode",
                                          "lens.focus_shift_mm",
                                          "lens.spherical",
                                          "lens.axial_colour",
                                          "lens.lateral_colour",
                                          "lens.added_spherical_waves",
                                          "lens.added_at_f_number",
                                          "lens.added_axial_colour_mm",
                                          "lens.added_field_curvature_mm",
                                          "lens.added_lateral_colour_percent",
                                          "lens.coma",
                                          "lens.astigmatism",
                                          "lens.light",
                                          "lens.wavelengths"};

Rules rules_of_lenses() {
    const auto blind_but_for = [](std::function<bool(const Look&)> shows) {
        return [shows = std::move(shows)](const Look& l) { return shows(l) ? std::string() : why_blind(l); };
    };
    // Falloff is measured against the middle: what is the same everywhere shows where the barrel cuts it.
    const auto is_cut = [](const Look& l) {
        return l.vignetting && (l.lens.cats_eye > 0 || !l.lens.barrel.empty());
    };
    const auto by_discs_alone = blind_but_for([](const Look&) { return false; });
    const auto without_images = [](const Look& l) { return unless(!has_images(l), kStandIn); };
    return {
        {{"lens.name"}, blind_but_for([](const Look& l) { return l.glare.ghosts > 0 || l.vignetting; })},
        {{"lens.blades", "lens.blade_rotation_deg", "lens.blade_curvature", "lens.squeeze"},
         blind_but_for([=](const Look& l) { return l.glare.star > 0 || l.glare.ghosts > 0 || is_cut(l); })},
        {{"lens.iris_open", "lens.barn_doors"}, blind_but_for(is_cut)},
        {{"lens.cats_eye", "lens.barrel"}, blind_but_for([](const Look& l) { return l.vignetting; })},
        {{"lens.kernel_image", "lens.wave"}, by_discs_alone},
        {kTexture, by_discs_alone},
        {kCharacter, by_discs_alone},
        {{"lens.name"},
         [](const Look& l) {
             return unless(!has_images(l) || l.glare.ghosts > 0 || l.vignetting, kStandIn);
         }},
        {kTexture, without_images},
        {kCharacter, without_images},
        {{"lens.blade_rotation_deg", "lens.blade_curvature", "lens.iris_open"},
         [](const Look& l) {
             return unless(l.lens.aperture.blades > 0, "without lens.blades, such as lens.blades 5");
         }},
        {{"lens.texture_seed"},
         [](const Look& l) {
             return unless(has_texture(l), "without lens.dust, lens.scratches or lens.onion_rings");
         }},
    };
}

Rules rules_of_character() {
    return {
        {{"lens.spherical", "lens.axial_colour", "lens.lateral_colour"},
         [](const Look& l) {
             return unless(l.lens.name != "ideal",
                           "on the ideal lens; give another with lens.name, or add some with "
                           "lens.added_spherical_waves, lens.added_axial_colour_mm or "
                           "lens.added_lateral_colour_percent");
         }},
        {{"lens.focus_mode", "lens.focus_shift_mm"},
         [](const Look& l) {
             return unless(l.lens.name != "ideal" || blurs_the_axis(l.lens.added),
                           "on the ideal lens; give another with lens.name");
         }},
        {{"lens.wavelengths"},
         [](const Look& l) {
             return unless(!is_of_lines(l.lens.light), std::string("with lens.light ") +
                                                           name_of(l.lens.light) +
                                                           ", whose lines are drawn one by one");
         }},
        {{"lens.light", "lens.wavelengths"},
         [](const Look& l) {
             return unless(l.lens.name != "ideal" || l.lens.wave || adds_colour(l.lens.added),
                           "on the ideal lens without lens.wave; give another with lens.name");
         }},
        {{"lens.added_at_f_number"},
         [](const Look& l) {
             return unless(l.lens.added.spherical_waves != 0, "without lens.added_spherical_waves");
         }},
        {{"lens.focus_shift_mm"},
         [](const Look& l) {
             return unless(l.lens.focus_mode == FocusMode::Shift, "without lens.focus_mode shift");
         }},
    };
}

Rules rules_of_light() {
    return {
        {{"glare.bloom_radius", "glare.bloom_threshold"},
         [](const Look& l) {
             return unless(l.glare.bloom > 0, "without glare.bloom, such as glare.bloom 0.1");
         }},
        {{"glare.star_radius", "glare.star_quality"},
         [](const Look& l) {
             return unless(l.glare.star > 0, "without glare.star, such as glare.star 0.1");
         }},
        {{"glare.coating"},
         [](const Look& l) {
             return unless(l.glare.ghosts > 0, "without glare.ghosts, such as glare.ghosts 0.02");
         }},
        {{"glare.coating"},
         [](const Look& l) {
             return unless(l.lens.name != "ideal",
                           "on the ideal lens, which has no surfaces; give another with lens.name");
         }},
        {{"glare.threshold"},
         [](const Look& l) {
             return unless(l.glare.star > 0 || l.glare.ghosts > 0,
                           l.glare.bloom > 0 ? "without glare.star or glare.ghosts; bloom has a separate "
                                               "threshold, glare.bloom_threshold"
                                             : "without glare.star or glare.ghosts");
         }},
        {{"plate.knee", "plate.peak"},
         [](const Look& l) { return unless(l.expand_highlights, "without plate.expand_highlights"); }},
    };
}

const Rules& all_rules() {
    static const Rules all = [] {
        Rules rules = rules_of_engines();
        for (const Rules& more :
             {rules_of_gather(), rules_of_lenses(), rules_of_character(), rules_of_light()})
            rules.insert(rules.end(), more.begin(), more.end());
        return rules;
    }();
    return all;
}

std::string why_idle(const Look& look, const std::string& field) {
    for (const Rule& rule : all_rules())
        if (std::find(rule.fields.begin(), rule.fields.end(), field) != rule.fields.end())
            if (std::string why = rule.why_idle(look); !why.empty()) return why;
    return "";
}

Status possible(const Look& look) {
    const auto refused = [](const char* field, const std::string& why) {
        return Error{ErrorCode::InvalidArgument, why, field};
    };
    const GlareAmounts& g = look.glare;
    if (g.star > 0 && look.lens.aperture.blades < 3)
        return refused("glare.star",
                       "glare.star needs an aperture with blades, such as lens.blades 6, because a round one "
                       "makes no spikes");
    if (g.bloom + g.star + g.ghosts + g.veil > 1)
        return refused("",
                       "glare.bloom, glare.star, glare.ghosts and glare.veil together take more than all "
                       "light");
    if (look.lens.wave && has_images(look))
        return refused("lens.wave", "lens.wave and lens.kernel_image contradict each other; give one");
    if (is_wgld(look) && look.gaussian.focus_band.value_or(0) > 1)
        return refused("gaussian.focus_band",
                       "gaussian.focus_band is a share of all depth with gaussian.style wgld, 0 to 1");
    return Done{};
}

}  // namespace

LookCheck check(const Look& look, const std::vector<std::string>& said) {
    static const Look defaults;
    LookCheck result{possible(look), {}};
    for (const look::Field& field : look::fields()) {
        const bool is_said = std::find(said.begin(), said.end(), field.path) != said.end();
        if (!is_said && field.get(look) == field.get(defaults)) continue;
        if (const std::string why = why_idle(look, field.path); !why.empty())
            result.idle.push_back(
                {ErrorCode::InvalidArgument, field.path + " has no effect " + why, field.path});
    }
    return result;
}

}  // namespace petzval
