#include "files/channels/channel_choice.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::HasSubstr;

Part part(const std::string& name, const std::vector<std::string>& channels, const std::string& view = "",
          const std::vector<std::string>& views = {}) {
    Part p;
    p.name = name, p.view = view, p.label = without_view(name, view);
    for (const std::string& c : channels) {
        p.channels.push_back(split_channel_name(c, views));
        if (p.channels.back().view.empty()) p.channels.back().view = view;
    }
    p.title = "part '" + name + "'";
    return p;
}

Layout layout(std::vector<Part> parts, std::vector<std::string> views = {}) {
    return {{0, 0, 4, 4}, 1, std::move(parts), std::move(views)};
}

std::string red_of(const Layout& l, const ReadOptions& options = {}) {
    const auto c = choose_colour("f.exr", l, options);
    if (!c) return c.error().message;
    return std::to_string(c->part) + " " + (c->is_luminance() ? c->luminance : c->red);
}

std::string depth_of(const Layout& l, const ReadOptions& options = {}, bool camera_matrix = false) {
    const auto c = choose_colour("f.exr", l, options);
    if (!c) return c.error().message;
    const auto d = choose_depth("f.exr", l, &*c, options, camera_matrix);
    if (!d) return d.error().message;
    return std::to_string(d->part) + " " + (d->is_position() ? d->position[2] : d->channel);
}

ReadOptions with_layer(const std::string& name) {
    ReadOptions o;
    o.layer = name;
    return o;
}

ReadOptions with_depth(const std::string& name) {
    ReadOptions o;
    o.depth_channel = name;
    return o;
}

TEST(ChannelChoice, DepthOfUnrealAndOctaneIsFoundAndMistIsNone) {
    EXPECT_EQ(depth_of(layout({part("", {"R", "G", "B", "FinalImageWorldDepth.R"})})),
              "0 FinalImageWorldDepth.R");
    const std::string movie = "FinalImageMovieRenderQueue_WorldDepth.R";  // in Epic's page on render passes
    EXPECT_EQ(depth_of(layout({part("", {"R", "G", "B", movie})})), "0 " + movie);
    EXPECT_EQ(depth_of(layout({part("", {"R", "G", "B", "Z-depth.R"})})), "0 Z-depth.R");
    EXPECT_THAT(depth_of(layout({part("", {"R", "G", "B", "ViewLayer.Mist.Z"})})),
                HasSubstr("not a distance"));
}

TEST(ChannelChoice, NamesThatCanBeTypedAreListed) {
    ReadOptions options;
    options.layer = "nothing";
    const Layout stereo =
        layout({part("rgba", {"R", "G", "B", "left.R", "left.G", "left.B"}, "", {"right", "left"})},
               {"right", "left"});
    EXPECT_THAT(red_of(stereo, options), HasSubstr("it has 'right', 'left'"));
    EXPECT_THAT(red_of(layout({part("", {"R", "G", "B"})}), options), HasSubstr("its colour has no name"));
    EXPECT_THAT(red_of(layout({part("", {"G"})})), HasSubstr("all of R, G and B are needed, or Y"));
}

TEST(ChannelChoice, ALayerWithoutColourIsToldHowItIsBlurred) {
    const Layout mattes = layout({part("", {"R", "G", "B", "key.R", "key.G", "key.B", "matte.ball", "N.X"})});
    for (const char* name : {"matte", "matte.ball"}) {
        ReadOptions options;
        options.layer = name;
        EXPECT_THAT(red_of(mattes, options), HasSubstr("it has 'key'"));
        EXPECT_THAT(red_of(mattes, options),
                    HasSubstr(std::string("holds no colour: read.layers ") + name + " blurs it beside"));
    }
    ReadOptions options;
    options.layer = "N";
    EXPECT_THAT(red_of(mattes, options), testing::EndsWith("'N' holds no colour"));
}

TEST(ChannelNames, SplitIntoLayerViewAndBaseAsOpenExrDefines) {
    const std::vector<std::string> views{"right", "left"};
    const auto parts_of = [&](const std::string& name) {
        const Channel c = split_channel_name(name, views);
        return c.layer + "|" + c.view + "|" + c.base;
    };
    EXPECT_EQ(parts_of("R"), "|right|R");
    EXPECT_EQ(parts_of("left.Z"), "|left|Z");
    EXPECT_EQ(parts_of("forward.left.u"), "forward|left|u");
    EXPECT_EQ(parts_of("disparityL.x"), "disparityL||x");
    EXPECT_EQ(parts_of("View.Combined.R"), "View.Combined||R");
    EXPECT_EQ(without_view("depth_left", "left"), "depth");
    EXPECT_EQ(without_view("left.depth", "left"), "depth");
    EXPECT_EQ(without_view("cleft", "left"), "cleft");
}

TEST(ColourChoice, PlainChannelsComeBeforeNamedLayersAndBeautyBeforeOthers) {
    EXPECT_EQ(red_of(layout({part("", {"A", "B", "G", "R", "diffuse.R", "diffuse.G", "diffuse.B"})})), "0 R");
    EXPECT_EQ(red_of(layout({part("", {"a.diffuse.B", "a.diffuse.G", "a.diffuse.R", "ViewLayer.Combined.B",
                                       "ViewLayer.Combined.G", "ViewLayer.Combined.R"})})),
              "0 ViewLayer.Combined.R");
    EXPECT_EQ(red_of(layout({part("diffuse", {"R", "G", "B"}), part("beauty", {"R", "G", "B"})})), "1 R");
    EXPECT_EQ(red_of(layout({part("", {"red", "green", "blue"})})), "0 red");
    EXPECT_EQ(red_of(layout({part("", {"Y", "Z"})})), "0 Y");
}

TEST(ColourChoice, IdentifiersNormalsAndDepthAreNoColour) {
    const std::vector<std::string> crypto{
        "CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b", "N.R", "N.G", "N.B"};
    EXPECT_THAT(red_of(layout({part("", crypto)})), HasSubstr("no colour"));
    EXPECT_EQ(red_of(layout({part("", crypto)}), with_layer("N")), "0 N.R");
    EXPECT_THAT(red_of(layout({part("", {"Z"})})), HasSubstr("no colour"));
}

TEST(ColourChoice, ALayerMayBeCalledByItsOwnNameItsPartOrBoth) {
    const Layout l =
        layout({part("rgba_right", {"R", "G", "B"}, "right"), part("rgba_left", {"R", "G", "B"}, "left"),
                part("aov", {"spec.R", "spec.G", "spec.B"})},
               {"right", "left"});
    EXPECT_EQ(red_of(l, with_layer("rgba_left")), "1 R");
    EXPECT_EQ(red_of(l, with_layer("RGBA_LEFT")), "1 R");
    EXPECT_EQ(red_of(l, with_layer("rgba")), "0 R");
    EXPECT_EQ(red_of(l, with_layer("spec")), "2 spec.R");
    EXPECT_EQ(red_of(l, with_layer("aov.spec")), "2 spec.R");
    EXPECT_THAT(red_of(l, with_layer("glow")), HasSubstr("'rgba_right', 'rgba_left', 'spec'"));
}

TEST(DepthChoice, KnowsTheNamesOfRenderersInOrder) {
    const auto with = [](std::vector<std::string> depth) {
        depth.insert(depth.end(), {"R", "G", "B"});
        return depth_of(layout({part("", depth)}));
    };
    EXPECT_EQ(with({"Z", "depth.Z"}), "0 Z");
    EXPECT_EQ(with({"depth.Z", "VRayZDepth.R"}), "0 depth.Z");
    EXPECT_EQ(with({"ViewLayer.Depth.Z"}), "0 ViewLayer.Depth.Z");
    EXPECT_EQ(with({"VRayZDepth.R", "depth.R"}), "0 VRayZDepth.R");
    EXPECT_EQ(with({"depth.R"}), "0 depth.R");
    EXPECT_EQ(with({"Depth.V"}), "0 Depth.V");
    EXPECT_EQ(with({"depth.Y"}), "0 depth.Y");
    EXPECT_EQ(with({"depth"}), "0 depth");
    EXPECT_EQ(with({"beauty.Z"}), "0 beauty.Z");
}

TEST(DepthChoice, AVectorsThirdComponentIsNoDepth) {
    const Layout l = layout({part("", {"R", "G", "B", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z"})});
    EXPECT_THAT(depth_of(l), HasSubstr("no depth channel"));
    EXPECT_EQ(depth_of(l, {}, true), "0 P.Z");
    EXPECT_EQ(depth_of(l, with_depth("N.Z")), "0 N.Z");
}

TEST(DepthChoice, FollowsTheViewAndTheViewLayerOfTheColour) {
    ReadOptions left;
    left.view_name = "left";
    const Layout one = layout(
        {part("", {"R", "G", "B", "Z", "left.R", "left.G", "left.B", "left.Z"}, "", {"right", "left"})},
        {"right", "left"});
    EXPECT_EQ(depth_of(one), "0 Z");
    EXPECT_EQ(depth_of(one, left), "0 left.Z");
    const Layout parts =
        layout({part("rgba_right", {"R", "G", "B"}, "right"), part("depth_left", {"Z"}, "left"),
                part("rgba_left", {"R", "G", "B"}, "left"), part("depth_right", {"Z"}, "right")},
               {"right", "left"});
    EXPECT_EQ(depth_of(parts), "3 Z");
    EXPECT_EQ(depth_of(parts, left), "1 Z");
    EXPECT_EQ(depth_of(parts, with_depth("depth_left.Z")), "1 Z");
    EXPECT_EQ(depth_of(parts, with_depth("Z")), "3 Z");
    const Layout layers =
        layout({part("", {"A.Depth.Z", "B.Combined.R", "B.Combined.G", "B.Combined.B", "B.Depth.Z"})});
    EXPECT_EQ(depth_of(layers), "0 B.Depth.Z");
}

TEST(DepthChoice, ADepthFileMayHoldOneChannelOrAGreyPicture) {
    const auto alone = [](const Layout& l) {
        const auto d = choose_depth("f.exr", l, nullptr, {}, false);
        return d ? d->channel : d.error().message;
    };
    EXPECT_EQ(alone(layout({part("", {"whatever"})})), "whatever");
    EXPECT_EQ(alone(layout({part("", {"B", "G", "R"})})), "R");
    EXPECT_EQ(alone(layout({part("", {"R", "G", "B", "Z"})})), "Z");
    EXPECT_THAT(alone(layout({part("", {"u", "v"})})), HasSubstr("'u', 'v'"));
}

}  // namespace
}  // namespace petzval
