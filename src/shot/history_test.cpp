#include "petzval/shot.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(History, ALineSaysLensCameraAndLayersAndIsKnownAgain) {
    Shot shot;
    shot.colour_name = "beauty.R";
    shot.depth = DepthMetres{};
    shot.camera.focal_length_mm = FoundNumber{85, ""}, shot.camera.f_number = FoundNumber{2.8, ""};
    shot.layers.emplace_back().names = {"diffuse", "specular"};
    Look look;
    look.lens.name = "doublet";
    const std::string line = history_line(shot, look);
    EXPECT_EQ(line.substr(0, 26), "defocus beauty.R: petzval ");
    EXPECT_NE(line.find(", scatter, doublet, 85 mm, f/2.8, with diffuse, specular"), std::string::npos)
        << line;
    EXPECT_FALSE(was_blurred(shot));
    shot.history = "rendered\n" + line;
    EXPECT_TRUE(was_blurred(shot));
    shot.colour_name = "R";
    EXPECT_FALSE(was_blurred(shot)) << "another colour of the same file";
}

TEST(History, GivenRadiiHaveNoCamera) {
    Shot shot;
    shot.depth = RadiiPx{};
    shot.camera.focal_length_mm = FoundNumber{85, ""};
    EXPECT_EQ(history_line(shot, {}).find("85 mm"), std::string::npos);
}

}  // namespace
}  // namespace petzval
