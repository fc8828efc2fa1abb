#include "command_line.h"

#include <gtest/gtest.h>

namespace petzval::view {
namespace {

// Rows as the program hands them over, one of each kind.
std::vector<FieldRow> rows() {
    const auto bare = [](const std::string& json) {
        return json.starts_with("\"") ? json.substr(1, json.size() - 2) : json;
    };
    const auto on_or_off = [](const std::string& json) { return std::string(json == "true" ? "on" : "off"); };
    return {{"Lens", "lens.name", "--lens", "NAME", "", {}, bare},
            {"Lens", "lens.blades", "--blades", "N", "", {}, bare},
            {"Lens", "lens.wave", "--wave", "", "", {}, bare},
            {"Focus", "lens.focus_mode", "--focus-mode", "best|paraxial", "", {}, bare},
            {"Focus", "lens.focus_shift_mm", "--focus-shift", "MM", "", {}, bare},
            {"Engine", "engine", "--engine", "NAME", "", {}, bare},
            {"Engine gather", "gather.taps", "--gather-taps", "16|22", "", {}, bare},
            {"Engine gather", "gather.fill", "--gather-fill", "off|on", "", {}, on_or_off}};
}

struct CommandLineTest : testing::Test {
    void SetUp() override {
        setup.fields = rows();
        setup.typed_files = {"in.exr", "--plate", "clean plate.exr"};
        setup.run.source.path = "in.exr";
        choice.input = input_of(setup.run.source);
    }
    std::string line(const std::string& output = "out.exr") const {
        return command_line(setup, choice, output);
    }

    view::Setup setup;
    Choice choice;
    const std::string begin = "petzval defocus in.exr --plate 'clean plate.exr' -o out.exr";
};

TEST_F(CommandLineTest, DefaultsNeedOnlyTheFilesAsTyped) { EXPECT_EQ(line(), begin); }

TEST_F(CommandLineTest, CameraNumbersAreSaidWhereTheyWereChosen) {
    choice.camera = {.focal_length_mm = 85, .f_number = 1.4, .focus_distance_m = 2.5};
    choice.camera.aperture_diameter_mm = 20;
    EXPECT_EQ(line(), begin + " --fstop 1.4 --focus 2.5 --focal-length 85") << "the f-number wins";
    choice.camera = {.image_scale = ImageScale::ThinLens, .aperture_diameter_mm = 20};
    EXPECT_EQ(line(), begin + " --aperture-diameter 20 --breathing on");
}

TEST_F(CommandLineTest, FieldsOfTheLookThatDifferFromTheDefaultsAreFlags) {
    choice.look.lens.name = "double gauss.json";
    choice.look.lens.wave = true;
    EXPECT_EQ(line(), begin + " --lens 'double gauss.json' --wave");
}

TEST_F(CommandLineTest, FieldsWithoutEffectAreLeftOutAsTheyWouldBeRefused) {
    choice.look.gather.taps = 16;
    choice.look.gather.fill_hidden = false;
    EXPECT_EQ(line(), begin) << "scatter has neither";
    choice.look.engine = "gather";
    EXPECT_EQ(line(), begin + " --engine gather --gather-fill off") << "taps are of published stages";
}

TEST_F(CommandLineTest, AShiftOfFocusImpliesItsMode) {
    choice.look.lens.name = "doublet";
    choice.look.lens.focus_mode = FocusMode::Shift;
    choice.look.lens.focus_shift_mm = 0.25;
    EXPECT_EQ(line(), begin + " --lens doublet --focus-shift 0.25");
}

TEST_F(CommandLineTest, AnotherFileReplacesTheTypedOnes) {
    choice.input.path = "other.exr";
    choice.input.depth_file = "z.png";
    choice.input.depth_kind = DepthKind::Normalized;
    choice.input.depth_near = 0.5, choice.input.depth_far = 40;
    choice.input.unit_scale_m = 0.01;
    EXPECT_EQ(line(),
              "petzval defocus other.exr --depth z.png --depth-kind normalized --depth-range 0.5,40 "
              "--unit-scale 0.01 -o out.exr");
}

TEST_F(CommandLineTest, AFrameOfAShotIsNamedInItsFiles) {
    setup.typed_files = {"in.####.exr"};
    choice.frame = 7;
    EXPECT_EQ(line(), "petzval defocus in.0007.exr -o out.exr");
}

TEST_F(CommandLineTest, OnlyDisplayPicturesNameTheirDisplay) {
    setup.run.display_view = "sRGB,Film";
    setup.session_settings.device = "gpu";
    choice.develop.exposure_stops = -1;
    EXPECT_EQ(line(), begin + " --device gpu");
    EXPECT_TRUE(line("a.png").ends_with("-o a.png --device gpu --tone filmic --exposure -1"))
        << line("a.png");
    choice.ocio = true;
    EXPECT_TRUE(line("a.png").ends_with(" --ocio sRGB,Film --exposure -1")) << line("a.png");
}

}  // namespace
}  // namespace petzval::view
