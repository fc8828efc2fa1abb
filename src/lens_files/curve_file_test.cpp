// Lenses drawn as aberration curves, read from files.
#include "lens_files/lens_file.h"

#include <random>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

const std::string kThreeCurves = R"({
 "id": "soft-rgb", "name": "soft portrait lens", "source": "drawn for a test",
 "focal_length_mm": 85, "f_number": 2.0, "sensor_width_mm": 36,
 "pupil_height": [0, 0.1, 0.2, 0.25],
 "curves": [
  {"wavelength_nm": 620, "shift": [0.001, 0, -0.002, -0.004]},
  {"wavelength_nm": "G",
   "shift": [0, -0.001, -0.003, -0.005]},
  {"wavelength_nm": 464, "shift": [0.001, 0, -0.001, -0.003]}
 ]
})";

std::string with(const std::string& from, const std::string& to) {
    std::string text = kThreeCurves;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
    const auto file = read_lens(text, "soft.json");
    return file ? "read without complaint" : file.error().message;
}

TEST(CurveFile, HoldsWhatItSays) {
    const auto file = read_lens(kThreeCurves, "soft.json");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_TRUE(file->curves);
    const optics::AberrationCurves& c = *file->curves;
    EXPECT_EQ(c.name, "soft-rgb");
    EXPECT_EQ(c.description, "soft portrait lens");
    EXPECT_EQ(c.focal_length_mm, 85);
    EXPECT_EQ(c.wavelength_nm, (std::vector<double>{464, 549, 620})) << "sorted; G is 549 nm";
    EXPECT_EQ(c.pupil_height, (std::vector<double>{0, 0.1, 0.2, 0.25}));
    EXPECT_EQ(c.shift[1], (std::vector<double>{0, -0.001, -0.003, -0.005}));
    EXPECT_EQ(file->lens.source, "drawn for a test");
    EXPECT_TRUE(file->warnings.empty());
}

TEST(CurveFile, InMillimetresIsTheSameLensDividedByItsFocalLength) {
    std::string text = with("\"f_number\"", "\"units\": \"mm\", \"f_number\"");
    const auto put = [&](const std::string& from, const std::string& to) {
        text.replace(text.find(from), from.size(), to);
    };
    put("[0, 0.1, 0.2, 0.25]", "[0, 8.5, 17, 21.25]");
    put("[0, -0.001, -0.003, -0.005]", "[0, -0.085, -0.255, -0.425]");
    const auto mm = read_lens(text, "soft.json"), focal_lengths = read_lens(kThreeCurves, "soft.json");
    ASSERT_TRUE(mm) << mm.error().message;
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(mm->curves->pupil_height[i], focal_lengths->curves->pupil_height[i], 1e-15);
        EXPECT_NEAR(mm->curves->shift[1][i], focal_lengths->curves->shift[1][i], 1e-15);
    }
}

TEST(CurveFile, DamageIsNamedWithItsLine) {
    EXPECT_EQ(refusal(with("-0.005]},", "]},")).substr(0, 17), "soft.json: line 8");
    EXPECT_EQ(refusal(with(", -0.005]", "]")).substr(0, 18), "soft.json: line 8:");
    EXPECT_EQ(refusal(with("-0.005]", "-5]")).substr(0, 18), "soft.json: line 8:");
    EXPECT_EQ(refusal(with("-0.005]", "\"far\"]")).substr(0, 18), "soft.json: line 8:");
    EXPECT_EQ(refusal(with("620", "62")).substr(0, 18), "soft.json: line 6:");
    EXPECT_EQ(refusal(with("620", "464")).substr(0, 18), "soft.json: line 9:") << "the same wavelength twice";
    EXPECT_EQ(refusal(with("[0, 0.1, 0.2,", "[0, 0.2, 0.1,")).substr(0, 18), "soft.json: line 4:");
    EXPECT_EQ(refusal(with("[0, 0.1,", "[0.01, 0.1,")).substr(0, 18), "soft.json: line 4:");
    EXPECT_EQ(refusal(with("0.2, 0.25]", "0.2, 0.24]")).substr(0, 18), "soft.json: line 4:")
        << "short of the rim";
    EXPECT_EQ(refusal(with("\"f_number\": 2.0", "\"f_number\": 0")).substr(0, 18), "soft.json: line 3:");
    EXPECT_EQ(refusal(with("\"f_number\": 2.0", "\"f_number\": 2.0, \"units\": \"inch\"")).substr(0, 18),
              "soft.json: line 3:");
    EXPECT_NE(refusal(with("\"f_number\": 2.0,", "")).find("f_number"), std::string::npos);
    EXPECT_NE(refusal(with("\"pupil_height\"", "\"heights\"")).find("pupil_height"), std::string::npos);
    EXPECT_NE(refusal(with("\"pupil_height\"", "\"surfaces\": [], \"pupil_height\"")).find("surfaces"),
              std::string::npos);
}

TEST(CurveFile, UnknownWordsAreSaid) {
    const auto file = read_lens(with("\"id\"", "\"colour\": \"pink\", \"id\""), "soft.json");
    ASSERT_TRUE(file);
    ASSERT_EQ(file->warnings.size(), 1u);
    EXPECT_NE(file->warnings[0].find("colour"), std::string::npos);
}

TEST(CurveFile, AnyBytesAreAnswered) {
    std::mt19937 random(11);
    for (int round = 0; round < 4000; ++round) {
        std::string text = kThreeCurves;
        for (int change = 0; change < 1 + int(random() % 3); ++change) {
            const std::size_t at = random() % text.size();
            if (random() % 3 == 0)
                text.erase(at, 1 + random() % 20);
            else
                text[at] = "0123456789.-eE[]{},:\""[random() % 21];
            if (text.empty()) break;
        }
        const auto file = read_lens(text, "mutant");
        if (!file || !file->curves) continue;
        EXPECT_TRUE(optics::check(*file->curves));
    }
}

}  // namespace
}  // namespace petzval::lens_files
