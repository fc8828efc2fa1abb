#include "files/channels/motion_choice.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::HasSubstr;

Part part(const std::string& name, const std::vector<std::string>& channels,
          const std::vector<std::string>& views = {}) {
    Part p;
    p.name = p.label = name;
    for (const std::string& c : channels) p.channels.push_back(split_channel_name(c, views));
    return p;
}

Result<std::optional<MotionChoice>> choice_of(std::vector<Part> parts, const std::string& layer = "",
                                              const std::string& view = "") {
    Layout layout;
    layout.parts = std::move(parts);
    ColourChoice colour;
    colour.view = view;
    return choose_motion("f.exr", layout, colour, {.wanted = true, .layer = layer});
}

// "X -Y": the channels with our signs.
std::string text(const std::optional<VectorChoice>& v) {
    if (!v) return "none";
    return (v->sign_x < 0 ? "-" : "") + v->x + " " + (v->sign_y < 0 ? "-" : "") + v->y;
}

TEST(MotionChoice, BlendersVectorsComeFromTheNextFrameAndGoToThePreviousOne) {
    const auto found = choice_of({part("", {"R", "G", "B", "ViewLayer.Vector.X", "ViewLayer.Vector.Y",
                                            "ViewLayer.Vector.Z", "ViewLayer.Vector.W"})});
    ASSERT_TRUE(found && *found);
    EXPECT_EQ(text((*found)->to_previous), "ViewLayer.Vector.X -ViewLayer.Vector.Y");
    EXPECT_EQ(text((*found)->to_next), "-ViewLayer.Vector.Z ViewLayer.Vector.W");
}

TEST(MotionChoice, ForwardAndBackwardMayLieInPartsOfTheirOwnAndBeOfOneView) {
    const auto both =
        choice_of({part("", {"R", "G", "B"}), part("forward", {"u", "v"}), part("backward", {"u", "v"})});
    ASSERT_TRUE(both && *both);
    EXPECT_EQ(text((*both)->to_next), "u -v");
    EXPECT_EQ((*both)->to_next->part, 1u);
    EXPECT_EQ((*both)->to_previous->part, 2u);
    const Part eyes =
        part("", {"R", "G", "B", "forward.left.u", "forward.left.v", "forward.right.u", "forward.right.v"},
             {"right", "left"});
    const auto right = choice_of({eyes}, "", "right");
    ASSERT_TRUE(right && *right);
    EXPECT_EQ(text((*right)->to_next), "forward.right.u -forward.right.v");
    EXPECT_EQ(text((*right)->to_previous), "none");
}

TEST(MotionChoice, AVectorByItselfIsTheWayToTheNextFrame) {
    for (const char* layer : {"motionvector", "VRayVelocity", "MotionVectors"}) {
        const std::string name = layer;
        const auto found = choice_of({part("", {"R", "G", "B", "Z", name + ".R", name + ".G", name + ".B"})});
        ASSERT_TRUE(found && *found) << layer;
        EXPECT_EQ(text((*found)->to_next), name + ".R -" + name + ".G");
    }
    const auto none = choice_of({part("", {"R", "G", "B", "N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z"})});
    ASSERT_TRUE(none);
    EXPECT_FALSE(*none);
}

TEST(MotionChoice, ALayerIsTakenByNameOrRefusedWithThoseThatThereAre) {
    const std::vector<std::string> channels{"R", "G", "B", "speed.x", "speed.y", "backward.u", "backward.v"};
    const auto speed = choice_of({part("", channels)}, "Speed");
    ASSERT_TRUE(speed && *speed);
    EXPECT_EQ(text((*speed)->to_next), "speed.x -speed.y");
    const auto backward = choice_of({part("", channels)}, "backward");
    ASSERT_TRUE(backward && *backward);
    EXPECT_EQ(text((*backward)->to_previous), "backward.u -backward.v");
    const auto refused = choice_of({part("", channels)}, "flow");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("'flow'"));
    EXPECT_THAT(refused.error().message, HasSubstr("speed"));
}

}  // namespace
}  // namespace petzval
