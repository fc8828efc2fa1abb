// Small files written here: what is right is seen where it stands, what is wrong is refused in one line.
#include "petzval/scene.h"

#include "base/temporary_folder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

std::string base64(const std::vector<unsigned char>& bytes) {
    static const char* kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](std::size_t k) { return i + k < bytes.size() ? unsigned(bytes[i + k]) : 0U; };
        const unsigned three = at(0) << 16 | at(1) << 8 | at(2);
        for (unsigned k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : kLetters[three >> (18 - 6 * k) & 63];
    }
    return text;
}

// A red square of 2 x 2, 3 m before a camera at the origin that looks along -z, and a smaller one 2 m away
// that glows green, up and to the right.
std::string two_squares() {
    const float places[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const std::uint16_t order[] = {0, 1, 2, 0, 2, 3};
    std::vector<unsigned char> bytes(sizeof places + sizeof order);
    std::memcpy(bytes.data(), places, sizeof places);
    std::memcpy(bytes.data() + sizeof places, order, sizeof order);
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"mesh":0,"translation":[0,0,-3]},{"mesh":1,"translation":[0.4,0.3,-2],"scale":[0.1,0.1,0.1]},{"camera":0}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.6,"znear":0.1}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1],"baseColorTexture":{"index":0}}},
{"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"emissiveFactor":[0,1,0]}],
"textures":[{"source":0}],"images":[{"uri":"missing.png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)" +
           base64(bytes) + "\"}]}";
}

class GltfScenes : public testing::Test {
protected:
    void SetUp() override {
        settings_.width = 64, settings_.height = 36, settings_.samples = 4, settings_.threads = 1;
        const auto built = build(two_squares());
        if (!built && built.error().code == ErrorCode::Unsupported) GTEST_SKIP() << built.error().message;
    }
    Result<StandingScene> build(const std::string& text) {
        std::ofstream(path_) << text;
        return StandingScene::build(path_, settings_);
    }
    // The error for the text with one part replaced.
    std::string refusal(const std::string& what, const std::string& instead) {
        std::string text = two_squares();
        EXPECT_NE(text.find(what), std::string::npos) << what;
        text.replace(text.find(what), what.size(), instead);
        const auto built = build(text);
        return built ? "" : built.error().message;
    }

    SceneSettings settings_;
    const test::TemporaryFolder folder_;
    const std::string path_ = folder_ / "scene.gltf";
};

TEST_F(GltfScenes, TrianglesStandWhereTheFilesCameraSeesThem) {
    auto standing = build(two_squares());
    ASSERT_TRUE(standing) << standing.error().message;
    // 0.6 rad of height on a sensor of 36 x 20.25 mm.
    EXPECT_NEAR(standing->camera().focal_length_mm, 0.5 * 20.25 / std::tan(0.3), 1e-4);
    const RenderedScene seen = standing->render(settings_).value();
    EXPECT_NEAR(seen.depth_m(32, 18), 3, 1e-4);
    EXPECT_GT(seen.colour(32, 18).r, 0.1f);
    EXPECT_FLOAT_EQ(seen.colour(32, 18).g, 0);
    // (0.4, 0.3) at 2 m: 18 / tan(0.3) px for a tangent of 1.
    const double px = 18 / std::tan(0.3);
    const int x = int(32 + 0.2 * px), y = int(18 - 0.15 * px);
    EXPECT_NEAR(seen.depth_m(x, y), 2, 1e-4);
    EXPECT_NEAR(seen.colour(x, y).g, 1, 1e-4);
    EXPECT_TRUE(std::isinf(seen.depth_m(0, 0)));
}

TEST_F(GltfScenes, ACameraThatIsNowhereOrFlatIsPassedOver) {
    for (const char* broken :
         {R"({"camera":0,"translation":[1e30,0,0]})", R"({"camera":0,"scale":[0,0,0]})"}) {
        std::string text = two_squares();
        const std::string sound = R"({"camera":0})";
        text.replace(text.find(sound), sound.size(), broken);
        auto standing = build(text);
        ASSERT_TRUE(standing) << standing.error().message;
        EXPECT_TRUE(standing->render(settings_)) << "from a place of our own";
    }
}

// The first square with a light above its middle, everything else dark.
std::string lit_by(const std::string& light, const std::string& place = "0,0,-2") {
    std::string text = two_squares();
    const auto replace = [&](const std::string& what, const std::string& instead) {
        text.replace(text.find(what), what.size(), instead);
    };
    replace(R"("nodes":[0,1,2])", R"("nodes":[0,1,2,3])");
    replace(R"({"camera":0}])", R"({"camera":0},{"translation":[)" + place +
                                    R"(],"extensions":{"KHR_lights_punctual":{"light":0}}}])");
    replace(R"({"asset")",
            R"({"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)" +
                light + R"(]}},"asset")");
    return text;
}

TEST_F(GltfScenes, LightsShineAsTheExtensionHasIt) {
    const auto red = [&](const std::string& light, int x) {
        auto standing = build(lit_by(light));
        EXPECT_TRUE(standing) << standing.error().message;
        return standing->render(settings_).value().colour(x, 18).r;
    };
    const auto added = [&](const std::string& kind, double intensity, int x) {
        const std::string rest = R"(,"type":)" + kind + "}";
        return red(R"({"intensity":)" + std::to_string(intensity) + rest, x) -
               red(R"({"intensity":1e-6)" + rest, x);
    };
    settings_.samples = 64;
    const double pi = 3.14159265358979, px = 18 / std::tan(0.3);
    // Straight above the middle 1 m away; at 40, 7.5 px aside on the square 3 m away.
    const double aside = 3 * 8.5 / px, far = std::hypot(1, aside);
    EXPECT_NEAR(added(R"("point")", 0.3, 32), 0.3 / pi, 2e-3);
    EXPECT_NEAR(added(R"("point")", 0.3, 40) / (0.3 / pi), std::pow(far, -3), 0.01);
    EXPECT_NEAR(added(R"("directional")", 0.3, 40), 0.3 / pi, 1e-4);
    const std::string spot = R"("spot","spot":{"innerConeAngle":0.1,"outerConeAngle":0.3})";
    EXPECT_NEAR(added(spot, 0.3, 32), 0.3 / pi, 2e-3);
    EXPECT_EQ(added(spot, 0.3, 42), 0);
}

TEST_F(GltfScenes, LightsThatAreTooBrightAreDimmedWithAllThatGlowsAndItIsSaid) {
    auto standing = build(lit_by(R"({"intensity":1000,"type":"directional"})"));
    ASSERT_TRUE(standing);
    EXPECT_NE(standing->warnings().back().find("8.4 stops"), std::string::npos)
        << standing->warnings().back();
    const RenderedScene seen = standing->render(settings_).value();
    EXPECT_LT(seen.colour(32, 18).r, 2);
    const double px = 18 / std::tan(0.3);
    EXPECT_NEAR(seen.colour(int(32 + 0.2 * px), int(18 - 0.15 * px)).g, 0.003, 1e-4);
}

TEST_F(GltfScenes, EmissionHasItsStrength) {
    std::string text = two_squares();
    const std::string glow = R"("emissiveFactor":[0,1,0])";
    text.replace(text.find(glow), glow.size(),
                 glow + R"(,"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":25}})");
    auto standing = build(text);
    ASSERT_TRUE(standing) << standing.error().message;
    const double px = 18 / std::tan(0.3);
    EXPECT_NEAR(standing->render(settings_).value().colour(int(32 + 0.2 * px), int(18 - 0.15 * px)).g, 25,
                1e-3);
}

// The first square goes from x = 0 to x = 1 within a second, and a second camera looks at it from 1 m away.
std::string moving(const std::string& path, const std::vector<float>& values, const std::string& law) {
    std::string text = two_squares();
    const auto replace = [&](const std::string& what, const std::string& instead) {
        ASSERT_NE(text.find(what), std::string::npos) << what;
        text.replace(text.find(what), what.size(), instead);
    };
    std::vector<unsigned char> bytes(2 * sizeof(float) + values.size() * sizeof(float));
    const float times[] = {0, 1};
    std::memcpy(bytes.data(), times, sizeof times);
    std::memcpy(bytes.data() + sizeof times, values.data(), values.size() * sizeof(float));
    const bool turns = path == "rotation";
    const std::string count = std::to_string(values.size() / (turns ? 4 : 3)),
                      length = std::to_string(bytes.size() - 8);
    replace(R"("nodes":[0,1,2])", R"("nodes":[0,1,2,3])");
    replace(R"({"camera":0}])", R"({"camera":0},{"camera":0,"name":"close","translation":[0,0,-2]}])");
    replace(R"("count":6,"type":"SCALAR"})",
            R"("count":6,"type":"SCALAR"},{"bufferView":2,"componentType":5126,"count":2,"type":"SCALAR"},
{"bufferView":3,"componentType":5126,"count":)" +
                count + R"(,"type":")" + (turns ? "VEC4" : "VEC3") + R"("})");
    replace(
        R"("byteOffset":48,"byteLength":12})",
        R"("byteOffset":48,"byteLength":12},{"buffer":1,"byteLength":8},{"buffer":1,"byteOffset":8,"byteLength":)" +
            length + "}");
    replace(R"("}]})", R"("},{"byteLength":)" + std::to_string(bytes.size()) +
                           R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes) + R"("}],
"animations":[{"samplers":[{"input":2,"output":3,"interpolation":")" +
                           law + R"("}],"channels":[{"sampler":0,"target":{"node":0,"path":")" + path +
                           R"("}}]}]})");
    return text;
}

TEST_F(GltfScenes, NodesStandWhereTheirAnimationsHaveThem) {
    // Beside it nothing is hit; so where its left edge is, is seen.
    const double px = 10 * 18 / std::tan(0.3) / 3;
    const auto left_m = [&](const std::string& law, const std::vector<float>& values, int frame) {
        settings_.frame = frame, settings_.width = 640, settings_.height = 36;
        auto standing = build(moving("translation", values, law));
        EXPECT_TRUE(standing) << standing.error().message;
        EXPECT_EQ(standing->frames(), 25);
        const RenderedScene seen = standing->render(settings_).value();
        int x = 0;
        while (x < 640 && std::isinf(seen.depth_m(x, 30))) ++x;
        return (x - 320) / px;
    };
    const std::vector<float> ends{0, 0, -3, 1, 0, -3};
    for (const int frame : {0, 6, 24})
        EXPECT_NEAR(left_m("LINEAR", ends, frame), frame / 24.0 - 1, 1 / px) << frame;
    EXPECT_NEAR(left_m("STEP", ends, 23), -1, 1 / px);
    EXPECT_NEAR(left_m("STEP", ends, 24), 0, 1 / px);
    // Tangents of 0: 3 t^2 - 2 t^3, at a quarter 10 / 64.
    const std::vector<float> spline{0, 0, 0, 0, 0, -3, 0, 0, 0, 0, 0, 0, 1, 0, -3, 0, 0, 0};
    EXPECT_NEAR(left_m("CUBICSPLINE", spline, 6), 10 / 64.0 - 1, 1 / px);
    settings_.frame = 25;
    EXPECT_FALSE(build(moving("translation", ends, "LINEAR")));
}

TEST_F(GltfScenes, RotationsGoAlongTheArc) {
    settings_.frame = 12;  // half of a quarter turn about y: the square stands at 45 degrees
    const float c = std::cos(0.785398f);
    auto standing = build(moving("rotation", {0, 0, 0, 1, 0, c, 0, c}, "LINEAR"));
    ASSERT_TRUE(standing) << standing.error().message;
    const double tangent = 8.5 / (18 / std::tan(0.3));  // of the pixel's middle
    const RenderedScene seen = standing->render(settings_).value();
    const double z = double(seen.depth_m(40, 18));
    EXPECT_NEAR(std::abs(z - 3), tangent * z, 1e-3);  // as far aside as it is nearer or farther
}

TEST_F(GltfScenes, OneOfItsCamerasCanBeChosen) {
    const std::string text = moving("translation", {0, 0, -3, 1, 0, -3}, "LINEAR");
    const auto depth = [&](const char* camera) {
        settings_.own_camera = camera;
        auto standing = build(text);
        EXPECT_TRUE(standing) << standing.error().message;
        EXPECT_EQ(standing->cameras(), (std::vector<std::string>{"1", "close"}));
        return standing->render(settings_).value().depth_m(32, 18);
    };
    EXPECT_NEAR(depth(""), 3, 1e-4);
    EXPECT_NEAR(depth("close"), 1, 1e-4);
    EXPECT_NEAR(depth("2"), 1, 1e-4);
    settings_.own_camera = "far";
    EXPECT_NE(build(text).error().message.find("close"), std::string::npos);
    EXPECT_FALSE(StandingScene::build("wgld", settings_));
}

TEST_F(GltfScenes, AnimationsThatAreBrokenAreRefused) {
    const std::string fine = moving("translation", {0, 0, -3, 1, 0, -3}, "LINEAR");
    for (const auto& [what, instead] : {std::pair{R"("input":2)", R"("input":9)"},
                                        {R"("input":2)", R"("input":3)"},
                                        {R"("output":3)", R"("output":2)"},
                                        {R"("node":0,)", R"("node":99,)"},
                                        {R"("LINEAR")", R"("CUBICSPLINE")"},
                                        {R"("sampler":0)", R"("sampler":4)"}}) {
        std::string text = fine;
        text.replace(text.find(what), std::strlen(what), instead);
        const auto built = build(text);
        ASSERT_FALSE(built) << instead;
        EXPECT_NE(built.error().message.find(path_), std::string::npos) << built.error().message;
    }
    EXPECT_FALSE(build(moving("translation", {0, 0, -3}, "LINEAR")));
    EXPECT_FALSE(build(moving("scale", {1, 1, 1, NAN, 1, 1}, "STEP")) &&
                 (settings_.frame = 24, build(moving("scale", {1, 1, 1, NAN, 1, 1}, "STEP"))));
}

TEST_F(GltfScenes, APictureThatIsMissingIsAWarningAndWhite) {
    const auto standing = build(two_squares());
    ASSERT_TRUE(standing);
    ASSERT_EQ(standing->warnings().size(), 1U);
    EXPECT_NE(standing->warnings()[0].find("missing.png"), std::string::npos) << standing->warnings()[0];
}

TEST_F(GltfScenes, WhatIsBrokenIsRefusedInOneLineThatNamesTheFile) {
    const std::pair<const char*, const char*> faults[] = {
        {R"("count":6)", R"("count":600)"},
        {R"("count":4)", R"("count":3)"},
        {R"("byteOffset":48)", R"("byteOffset":4000000000)"},
        {R"("nodes":[0,1,2])", R"("nodes":[0,1,9])"},
        {R"("camera":0})", R"("children":[2]})"},
        {R"("mesh":1)", R"("mesh":7)"},
        {R"("POSITION":0)", R"("POSITION":1)"},
        {R"("bufferView":1,"componentType":5123)",
         R"("bufferView":0,"componentType":5120)"},  // indices below 0
        {R"("scale":[0.1,0.1,0.1])", R"("scale":[1e300,1e300,1e300])"},
        {R"("asset":{"version":"2.0"})",
         R"("asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"])"},
    };
    for (const auto& [what, instead] : faults) {
        const std::string said = refusal(what, instead);
        EXPECT_NE(said.find(path_), std::string::npos) << instead << ": " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    EXPECT_FALSE(StandingScene::build("nowhere.glb", settings_));
}

TEST_F(GltfScenes, WhereverAFileEndsNothingBreaks) {
    const std::string whole = two_squares();
    for (std::size_t length = 0; length + 1 < whole.size(); length += 17) {
        const auto built = build(whole.substr(0, length));
        ASSERT_FALSE(built) << length;
        EXPECT_EQ(built.error().message.find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace petzval
