#include "petzval/look.h"

#include "petzval/look_json.h"

#include "look/fields.h"

#include <functional>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using look::Field;
using look::fields;

using Changes = std::vector<std::function<void(Look&)>>;

Changes changes_of_focus_and_lens() {
    return {[](Look& l) { l.engine = "gather"; },
            [](Look& l) { l.quality = Quality::Draft; },
            [](Look& l) { l.seed = std::numeric_limits<std::uint64_t>::max(); },
            [](Look& l) { l.pupil_points = 7; },
            [](Look& l) { l.fill = Fill::Dim; },
            [](Look& l) {
                l.coc.focus_near_m = 1.7, l.coc.focus_far_m = std::numeric_limits<double>::infinity();
            },
            [](Look& l) { l.coc.focus_falloff = 0.1; },
            [](Look& l) { l.coc.near_scale = 1.0 / 3; },
            [](Look& l) { l.coc.far_scale = 0; },
            [](Look& l) { l.coc.max_radius_px = 1e-300; },
            [](Look& l) { l.lens.name = "Objektiv \"ä\"\n.json"; },
            [](Look& l) { l.lens.aperture.blades = 5; },
            [](Look& l) { l.lens.aperture.rotation_deg = -17.5; },
            [](Look& l) { l.lens.aperture.curvature = 0.3; },
            [](Look& l) { l.lens.aperture.squeeze = 2; },
            [](Look& l) { l.lens.aperture.round_at_f_number = 2.8; },
            [](Look& l) { l.lens.cats_eye = 0.7; },
            [](Look& l) {
                l.lens.barrel = {{14, 20}, {14.1, -20}};
            },
            [](Look& l) {
                l.lens.barn_doors = {0.1, 0.2, 0.3, 0.4};
            },
            [](Look& l) { l.aperture_image = "heart.png"; },
            [](Look& l) { l.kernel_image_far = "far.exr"; },
            [](Look& l) { l.kernel_image_far = "far.exr", l.kernel_image_near = "near.exr"; },
            [](Look& l) { l.lens.texture.dust = 0.1; },
            [](Look& l) { l.lens.texture.scratches = 0.2; },
            [](Look& l) { l.lens.texture.onion_rings = 0.3; },
            [](Look& l) { l.lens.texture.seed = 9; },
            [](Look& l) { l.lens.focus_mode = FocusMode::Shift; },
            [](Look& l) { l.lens.focus_shift_mm = -0.05; },
            [](Look& l) { l.lens.spherical = -1; },
            [](Look& l) { l.lens.axial_colour = 0; },
            [](Look& l) { l.lens.lateral_colour = 0.5; },
            [](Look& l) { l.lens.coma = 2; },
            [](Look& l) { l.lens.added.spherical_waves = 3; },
            [](Look& l) { l.lens.added.at_f_number = 2; },
            [](Look& l) { l.lens.added.axial_colour_mm = 0.2; },
            [](Look& l) { l.lens.added.field_curvature_mm = -0.3; },
            [](Look& l) { l.lens.added.lateral_colour_percent = 0.5; },
            [](Look& l) { l.lens.astigmatism = -2; },
            [](Look& l) { l.lens.light = LightSpectrum::Mercury; },
            [](Look& l) { l.lens.distortion = 0.05; },
            [](Look& l) { l.lens.wavelengths = 12; },
            [](Look& l) { l.lens.wave = true; }};
}

Changes changes_of_engines_and_light() {
    return {[](Look& l) { l.gather.stage = GatherStage::NearFar; },
            [](Look& l) { l.gather.taps = 71; },
            [](Look& l) { l.gather.tap_offset = 1; },
            [](Look& l) { l.gather.pixel_size_px = 0.5; },
            [](Look& l) { l.gather.blurred_px = 3; },
            [](Look& l) { l.gather.extreme_coc = true; },
            [](Look& l) { l.gather.fill_hidden = false; },
            [](Look& l) { l.gaussian.style = GaussianStyle::Wgld; },
            [](Look& l) { l.gaussian.focus_band = 0.0; },
            [](Look& l) { l.gaussian.depth_offset = -0.25; },
            [](Look& l) { l.gaussian.along_ray = true; },
            [](Look& l) { l.gaussian.depth_near_m = 0.1, l.gaussian.depth_far_m = 30; },
            [](Look& l) { l.sprites.background = SpriteBackground::Gaussian; },
            [](Look& l) { l.sprites.find = false; },
            [](Look& l) { l.sprites.bright_factor = 7; },
            [](Look& l) { l.glare.bloom = 0.1; },
            [](Look& l) { l.glare.bloom_radius = 0.2; },
            [](Look& l) { l.glare.bloom_threshold = 2; },
            [](Look& l) { l.glare.star = 0.3; },
            [](Look& l) { l.glare.star_radius = 0.4; },
            [](Look& l) { l.glare.star_quality = StarQuality::Draft; },
            [](Look& l) { l.glare.ghosts = 0.6; },
            [](Look& l) { l.glare.coating = LensCoating::None; },
            [](Look& l) { l.glare.veil = 0.8; },
            [](Look& l) { l.glare.threshold = 0; },
            [](Look& l) { l.vignetting = true; },
            [](Look& l) { l.depth_edges = DepthEdges::Snap; },
            [](Look& l) { l.expand_highlights = true; },
            [](Look& l) { l.expansion.knee = 0.25; },
            [](Look& l) { l.expansion.peak = 30; }};
}

// Each changes one member of a look that is written.
Changes changes() {
    Changes all = changes_of_focus_and_lens();
    for (auto& change : changes_of_engines_and_light()) all.push_back(std::move(change));
    return all;
}

std::set<std::string> differing_fields(const Look& a, const Look& b) {
    std::set<std::string> paths;
    for (const Field& field : fields())
        if (field.get(a) != field.get(b)) paths.insert(field.path);
    return paths;
}

TEST(LookJson, EveryChangeComesBack) {
    Look all;
    for (const auto& change : changes()) {
        Look look;
        change(look), change(all);
        for (const Look& one : {look, all}) {
            const Result<Look> read = look_from_json(look_to_json(one));
            ASSERT_TRUE(read) << read.error().message;
            EXPECT_EQ(*read, one) << look_to_json(one);
        }
    }
}

TEST(LookJson, EveryFieldIsChangedByOneChangeAtLeast) {
    std::set<std::string> seen;
    for (const auto& change : changes()) {
        Look look;
        change(look);
        EXPECT_NE(look, Look{});
        const auto differing = differing_fields(look, {});
        EXPECT_EQ(differing.size(), 1u) << look_to_json(look);
        seen.insert(differing.begin(), differing.end());
    }
    for (const Field& field : fields()) EXPECT_EQ(seen.count(field.path), 1u) << field.path;
    EXPECT_EQ(seen.size(), fields().size());
}

TEST(LookJson, WhatIsLeftOutIsAtItsDefault) {
    const Result<Look> read = look_from_json(R"({"petzval_look": 1, "lens": {"blades": 5}, "glare": {}})");
    ASSERT_TRUE(read) << read.error().message;
    Look wanted;
    wanted.lens.aperture.blades = 5;
    EXPECT_EQ(*read, wanted);
}

std::string refusal(const std::string& text) {
    const Result<Look> read = look_from_json(text);
    if (read) return "";
    EXPECT_EQ(read.error().code, ErrorCode::InvalidFile);
    return read.error().message;
}
std::string refusal_of(const std::string& members) {
    return refusal("{\"petzval_look\": 1, " + members + "}");
}

TEST(LookJson, UnknownKeysAreRefusedByNameWithTheKnownOneThatTheyResemble) {
    EXPECT_EQ(refusal_of(R"("lens": {"comma": 1})"), "unknown key lens.comma (did you mean lens.coma?)");
    EXPECT_EQ(refusal_of(R"("qualty": "draft")"), "unknown key qualty (did you mean quality?)");
    EXPECT_EQ(refusal_of(R"("glare": {"dust": 1})"), "unknown key glare.dust (did you mean lens.dust?)");
    EXPECT_EQ(refusal_of(R"("blades": 5)"), "unknown key blades (did you mean lens.blades?)");
    EXPECT_EQ(refusal_of(R"("zebra": {})"), "unknown key zebra");
}

TEST(LookJson, WrongTypesAreRefusedByPath) {
    EXPECT_EQ(refusal_of(R"("lens": {"blades": "five"})"),
              "lens.blades: must be a whole number of 32 bits, not \"five\"");
    EXPECT_EQ(refusal_of(R"("lens": {"blades": 5.5})"),
              "lens.blades: must be a whole number of 32 bits, not 5.5");
    EXPECT_EQ(refusal_of(R"("lens": {"blades": 5000000000})"),
              "lens.blades: must be a whole number of 32 bits, not 5000000000");
    EXPECT_EQ(refusal_of(R"("seed": -1)"), "seed: must be a whole number of 0 or more, not -1");
    EXPECT_EQ(refusal_of(R"("quality": "best")"), "quality: \"best\" is not one of draft, standard, final");
    EXPECT_EQ(refusal_of(R"("quality": 2)"), "quality: must be a name, not 2");
    EXPECT_EQ(refusal_of(R"("lens": {"wave": 1})"), "lens.wave: must be true or false, not 1");
    EXPECT_EQ(refusal_of(R"("lens": {"coma": null})"), "lens.coma: must be a number, not null");
    EXPECT_EQ(refusal_of(R"("lens": {"barn_doors": [1, 2, 3]})"),
              "lens.barn_doors: must be a list of four numbers: left, right, top, bottom, not this list");
    EXPECT_NE(refusal_of(R"("lens": {"barrel": [{"radius": 1}]})").find("lens.barrel: "), std::string::npos);
    EXPECT_NE(refusal_of(R"("lens": {"kernel_image": [""]})").find("lens.kernel_image: "), std::string::npos);
    EXPECT_NE(refusal_of(R"("gather": {"coc": "median"})").find("gather.coc: "), std::string::npos);
    EXPECT_NE(refusal_of(R"("lens": 5)").find("lens: must be an object"), std::string::npos);
}

TEST(LookJson, WhatIsNoLookIsRefused) {
    EXPECT_EQ(refusal(""), "is not JSON: line 1, column 1");
    EXPECT_EQ(refusal("{"), "is not JSON: line 1, column 2");
    EXPECT_EQ(refusal("{\"petzval_look\": 1} x"), "is not JSON: line 1, column 21");
    EXPECT_EQ(refusal("{\"petzval_look\": 1,\n \"lens\": {\"blades\": 5,}}"),
              "is not JSON: line 2, column 23");
    EXPECT_EQ(refusal("{\"petzval_look\": 1, // mine\n}"), "is not JSON: line 1, column 21");
    EXPECT_EQ(refusal("{\"petzval_look\": 1,\n\n\"seed\": NaN}"), "is not JSON: line 3, column 9");
    EXPECT_EQ(refusal("[]"), "is not a look: not an object");
    EXPECT_EQ(refusal("{}"), "is not a look: it has no \"petzval_look\": 1");
    EXPECT_EQ(refusal("{\"petzval_look\": 2}"),
              "comes from a later version: petzval_look 2, this one reads 1");
    EXPECT_EQ(refusal("{\"petzval_look\": \"1\"}"), "petzval_look: must be 1");
    EXPECT_EQ(refusal_of(R"("lens": {"coma": 1, "coma": 2})"), "holds the key coma twice");
}

TEST(LookJson, DeepNestingIsRefusedAndNotFollowed) {
    const std::string deep(100000, '[');
    EXPECT_NE(refusal_of("\"seed\": " + deep + std::string(100000, ']')), "");
    EXPECT_NE(refusal(deep), "");
}

TEST(LookWith, SetsOneFieldByItsPath) {
    const auto with = [](const char* path, const char* value) { return look_with({}, path, value); };
    EXPECT_EQ(with("engine", "gather")->engine, "gather");
    EXPECT_EQ(with("lens.name", "\"doublet\"")->lens.name, "doublet");
    EXPECT_EQ(with("lens.blades", "5")->lens.aperture.blades, 5);
    EXPECT_EQ(with("quality", "final")->quality, Quality::Final);
    EXPECT_EQ(with("lens.wave", "true")->lens.wave, true);
    // A file may be called like a number.
    EXPECT_EQ(with("lens.name", "50")->lens.name, "50");
}

TEST(LookWith, RefusesWhatItDoesNotKnow) {
    const auto refusal = [](const char* path, const char* value) {
        const auto look = look_with({}, path, value);
        return look ? std::string("taken") : look.error().message;
    };
    EXPECT_NE(refusal("lens.blade", "5").find("lens.blades"), std::string::npos);
    EXPECT_NE(refusal("lens.blades", "many").find("lens.blades"), std::string::npos);
    EXPECT_NE(refusal("quality", "best").find("best"), std::string::npos);
    EXPECT_NE(refusal("depth.edges", "\xb5").find("depth.edges"), std::string::npos);  // no UTF-8
    EXPECT_EQ(refusal("engine", ""), "engine: must be a name, not \"\"");
    EXPECT_EQ(refusal("lens.name", "\"\""), "lens.name: must be a name, not \"\"");
    EXPECT_EQ(refusal("glare.bloom", "inf"), "glare.bloom: must be from 0 to 1, not \"inf\"");
}

}  // namespace
}  // namespace petzval
