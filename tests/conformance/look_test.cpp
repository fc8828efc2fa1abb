// Every choice of a look shows in the picture, or check() says that it does not: of every engine, with every
// kind of lens, each field changed by itself.
#include "petzval/look.h"

#include "petzval/look_check.h"
#include "petzval/look_json.h"
#include "petzval/session.h"

#include "drawers.h"

#include <sstream>

namespace petzval::conformance {
namespace {

using Choice = std::pair<const char*, const char*>;  // a field's path and a value

std::vector<Choice> changes_of_light() {
    return {{"glare.bloom", "0.2"},
            {"glare.bloom_radius", "0.3"},
            {"glare.bloom_threshold", "0.5"},
            {"glare.star", "0.2"},
            {"glare.star_radius", "0.2"},
            {"glare.star_quality", "draft"},
            {"glare.ghosts", "0.2"},
            {"glare.coating", "none"},
            {"glare.veil", "0.2"},
            {"glare.threshold", "0.5"},
            {"glare.vignetting", "true"},
            {"plate.expand_highlights", "true"},
            {"plate.knee", "0.2"},
            {"plate.peak", "5"}};
}

std::vector<Choice> changes_of_all_else() {
    return {{"quality", "draft"},
            {"seed", "7"},
            {"pupil_points", "23"},
            {"fill", "off"},
            {"depth.edges", "keep"},
            {"focus.range_m", "[1.5, 3]"},
            {"focus.falloff", "0.3"},
            {"focus.near_scale", "0.5"},
            {"focus.far_scale", "0.5"},
            {"focus.max_radius_px", "2.5"},
            {"lens.name", "tessar"},
            {"lens.blades", "3"},
            {"lens.blade_rotation_deg", "31"},
            {"lens.blade_curvature", "0.6"},
            {"lens.squeeze", "1.7"},
            {"lens.iris_open", "4"},
            {"lens.cats_eye", "0.9"},
            {"lens.barrel", R"([{"radius_mm": 30, "distance_mm": -60}])"},
            {"lens.barn_doors", "[0.8, 0, 0, 0.3]"},
            {"lens.aperture_image", "half.png"},
            {"lens.kernel_image", R"(["disc.exr"])"},
            {"lens.dust", "0.9"},
            {"lens.scratches", "0.9"},
            {"lens.onion_rings", "0.9"},
            {"lens.texture_seed", "5"},
            {"lens.focus_mode", "paraxial"},
            {"lens.focus_shift_mm", "0.3"},
            {"lens.spherical", "-1"},
            {"lens.axial_colour", "-3"},
            {"lens.lateral_colour", "-3"},
            {"lens.added_spherical_waves", "60"},
            {"lens.added_at_f_number", "3"},
            {"lens.added_axial_colour_mm", "-2"},
            {"lens.added_field_curvature_mm", "-2"},
            {"lens.added_lateral_colour_percent", "4"},
            {"lens.coma", "3"},
            {"lens.astigmatism", "4"},
            {"lens.distortion", "0.2"},
            {"lens.light", "sodium"},
            {"lens.wavelengths", "3"},
            {"lens.wave", "true"},
            {"gather.stage", "near-far"},
            {"gather.taps", "16"},
            {"gather.tap_offset", "1"},
            {"gather.pixel_size_px", "0.6"},
            {"gather.blurred_px", "3"},
            {"gather.coc", "extreme"},
            {"gather.fill", "false"},
            {"gaussian.style", "plain"},
            {"gaussian.focus_band", "0.8"},
            {"gaussian.depth_offset", "0.1"},
            {"gaussian.depth_along", "ray"},
            {"gaussian.depth_band_range_m", "[0.5, 30]"},
            {"sprites.background", "gaussian"},
            {"sprites.find_points", "false"},
            {"sprites.bright_factor", "12"}};
}

// Each field once, at a value that is not its default.
const std::vector<Choice>& changes() {
    static const std::vector<Choice> all = [] {
        std::vector<Choice> every = changes_of_all_else();
        for (const Choice& choice : changes_of_light()) every.push_back(choice);
        return every;
    }();
    return all;
}

Picture half_dark() {
    Picture disc(24, 24, {1, 1, 1, 1});
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 11; ++x) disc(x, y) = {0.1f, 0.2f, 0.1f, 1};
    return disc;
}

Look with(Look look, const std::vector<Choice>& choices) {
    for (const auto& [path, value] : choices) {
        const auto changed = look_with(look, path, value);
        EXPECT_TRUE(changed) << changed.error().message;
        if (changed) look = *changed;
    }
    return look;
}

// A plate of low range, so that highlights can be given back to it: a wall, a bar before it, lamps at both.
struct Plate {
    Picture colour{40, 30};
    Plane depth_m{40, 30, 9.0f};
    DefocusJob job;

    Plate() {
        std::mt19937 random(4);
        std::uniform_real_distribution<float> value(0.02f, 0.2f);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                colour(x, y) = {value(random), value(random), value(random), 1};
                if (x >= 17 && x < 21) depth_m(x, y) = 1.2f;
                if (x >= 33) depth_m(x, y) = 2;
                if (y >= 24) depth_m(x, y) = 3;
            }
        colour(8, 8) = colour(19, 20) = colour(36, 6) = {1.04f, 1.02f, 0.9f, 1};
        job.colour = colour, job.depth_m = depth_m;
        job.place = Place::whole(colour.rect());
        job.camera = {.focal_length_mm = 300, .sensor_width_mm = 36, .f_number = 5, .focus_distance_m = 2};
    }

    // The picture; nothing where the look is refused.
    Picture taken(Session& session, Look look) const {
        if (!look.kernel_image_far.empty())
            look.lens.kernel_images.far = std::make_shared<const Picture>(half_dark());
        if (!look.aperture_image.empty()) {
            Plane half(16, 16, 1.0f);
            for (int y = 0; y < 16; ++y)
                for (int x = 0; x < 6; ++x) half(x, y) = 0.1f;
            look.lens.texture.image = std::make_shared<const Plane>(std::move(half));
        }
        auto report = session.take(job, look);
        return report ? std::move(report->image) : Picture();
    }
};

bool is_idle(const Look& look, const std::string& path) {
    for (const Error& idle : check(look).idle)
        if (idle.field == path) return true;
    return false;
}

// True if a field has an effect on some pictures only: on soft silhouettes, on discs large enough to be
// simplified, on radii in front of focus if a method uses the largest, on light that is bright after the
// blur, on rims that cut a beam, on radii of about a pixel.
bool depends_on_the_shot(const std::string& path) {
    return path == "quality" || path == "depth.edges" || path == "focus.near_scale" ||
           path == "gather.pixel_size_px" || path == "gather.blurred_px" || path == "glare.ghosts" ||
           path == "lens.name";
}

// Checks the fields whose paths begin with the prefix.
void expect_choices_to_show_or_be_told(const Drawer& drawer, const Look& base,
                                       const std::vector<std::string>& beginnings) {
    static const Plate plate;
    Session session(drawer.session());
    const Picture before = plate.taken(session, base);
    ASSERT_FALSE(before.empty());
    for (const auto& [path, value] : changes()) {
        const auto begins = [&, path = path](const std::string& b) {
            return std::string(path).starts_with(b);
        };
        if (std::none_of(beginnings.begin(), beginnings.end(), begins)) continue;
        const Look look = with(base, {{path, value}});
        const bool idle = is_idle(look, path);
        if (look == base || look.lens.wave) continue;  // waves take long, and show where they are wide
        const Picture after = plate.taken(session, look);
        if (after.empty()) continue;
        const bool same = largest_difference(before, after) == 0;
        if (same != idle && !(same && depends_on_the_shot(path)))
            ADD_FAILURE() << path << " " << value
                          << (same ? " changes nothing, and nobody says so"
                                   : " is said to have no effect, and has one");
    }
}

// On every device, of the fields whose paths begin so, or of all.
void expect_choices_to_show_or_be_told(const std::vector<Choice>& choices,
                                       const std::vector<std::string>& beginnings = {""}) {
    std::string all;
    for (const auto& [path, value] : choices) all += std::string(path) + " " + value + ", ";
    SCOPED_TRACE(all);
    Look base;
    base.pupil_points = 16;
    base = with(base, choices);
    for (const std::string& device : device_names())
        expect_choices_to_show_or_be_told(Drawer{base.engine, device}, base, beginnings);
}

TEST(LookChoices, EveryFieldIsAmongThem) {
    std::istringstream json(look_to_json({}));
    int fields = -1;  // the version is none
    for (std::string line; std::getline(json, line);)
        fields += line.find("\": ") != std::string::npos && line.back() != '{';
    EXPECT_EQ(changes().size() + 1, std::size_t(fields));  // and the engine
}

class EveryLook : public testing::TestWithParam<std::vector<Choice>> {};

TEST_P(EveryLook, ShowsWhatIsChosenOrSaysThatItDoesNot) { expect_choices_to_show_or_be_told(GetParam()); }

std::string name_of_case(const testing::TestParamInfo<std::vector<Choice>>& tested) {
    std::string name;
    for (const auto& [path, value] : tested.param)
        for (const char* c = value; *c; ++c) name += std::isalnum(*c) ? *c : '_';
    return name;
}

using Choices = std::vector<Choice>;
INSTANTIATE_TEST_SUITE_P(Engines, EveryLook,
                         testing::Values(Choices{{"engine", "scatter"}}, Choices{{"engine", "reference"}},
                                         Choices{{"engine", "gather"}},
                                         Choices{{"engine", "gather"}, {"gather.stage", "coc"}},
                                         Choices{{"engine", "gather"}, {"gather.stage", "prefilter"}},
                                         Choices{{"engine", "gather"}, {"gather.stage", "disc"}},
                                         Choices{{"engine", "gather"}, {"gather.stage", "cure"}},
                                         Choices{{"engine", "gaussian"}},
                                         Choices{{"engine", "gaussian"}, {"gaussian.style", "wgld"}},
                                         Choices{{"engine", "sprites"}},
                                         Choices{{"engine", "sprites"}, {"sprites.background", "gaussian"}}),
                         name_of_case);

TEST(LookChoices, OfALensDrawnAsCurves) {
    for (const char* engine : {"scatter", "gaussian"})
        expect_choices_to_show_or_be_told(
            {{"engine", engine}, {"lens.name", "uncorrected"}, {"lens.blades", "5"}}, {"lens."});
}

TEST(LookChoices, OfDust) {
    expect_choices_to_show_or_be_told({{"lens.dust", "0.5"}}, {"lens.texture_seed"});
}

TEST(LookChoices, OfATracedLens) {
    expect_choices_to_show_or_be_told({{"lens.name", "tessar"}, {"glare.ghosts", "0.1"}}, {"glare."});
    expect_choices_to_show_or_be_told({{"lens.name", "tessar"}}, {"lens.axial", "lens.c", "lens.f", "lens.l",
                                                                  "lens.sp", "lens.wavelengths"});
}

TEST(LookChoices, OfAPictureInPlaceOfALens) {
    expect_choices_to_show_or_be_told({{"lens.kernel_image", R"(["disc.exr"])"}, {"lens.blades", "5"}},
                                      {"lens."});
}

TEST(LookChoices, OfGlareAfterABlurThatKnowsNoLens) {
    expect_choices_to_show_or_be_told({{"engine", "gaussian"},
                                       {"glare.star", "0.1"},
                                       {"glare.bloom", "0.1"},
                                       {"glare.ghosts", "0.1"},
                                       {"lens.blades", "5"}},
                                      {"glare.", "lens.name", "lens.blade", "lens.squeeze", "lens.cats_eye"});
    const Choices dimmed{{"engine", "gaussian"}, {"glare.vignetting", "true"}, {"lens.blades", "5"}};
    const std::vector<std::string> barrel{"lens.name", "lens.b", "lens.squeeze", "lens.iris",
                                          "lens.cats_eye"};
    expect_choices_to_show_or_be_told(dimmed, barrel);
    Choices cut = dimmed;
    cut.push_back({"lens.cats_eye", "0.5"});
    expect_choices_to_show_or_be_told(cut, barrel);
}

TEST(LookChoices, OfAPlateWithARangeInFocus) {
    expect_choices_to_show_or_be_told({{"plate.expand_highlights", "true"}, {"focus.range_m", "[1.8, 2.5]"}},
                                      {"focus.", "plate."});
}

}  // namespace
}  // namespace petzval::conformance
