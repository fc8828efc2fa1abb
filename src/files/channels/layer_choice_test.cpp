#include "files/channels/layer_choice.h"

#include <gmock/gmock.h>
#include <map>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Part part(const std::string& name, const std::vector<std::string>& channels,
          const Rect& window = {0, 0, 8, 8}) {
    Part p;
    p.name = p.label = name;
    p.data_window = window;
    for (const std::string& c : channels) p.channels.push_back(split_channel_name(c, {}));
    return p;
}

// Layers to blur, as "name: channels", and the reason for all others.
struct Chosen {
    std::vector<std::string> blurred;
    std::map<std::string, std::string> carried;
    std::string refused;
};

Chosen chosen(const Layout& layout, const std::vector<std::string>& layers) {
    ReadOptions options;
    options.layers = layers;
    const auto colour = choose_colour("f.exr", layout, {});
    if (!colour) return {{}, {}, colour.error().message};
    const auto depth = choose_depth("f.exr", layout, &*colour, {}, false);
    const auto choice =
        choose_layers("f.exr", layout, *colour, depth ? std::optional(*depth) : std::nullopt, options);
    if (!choice) return {{}, {}, choice.error().message};
    Chosen c;
    for (const LayerChoice& layer : choice->layers) {
        std::string line;
        for (const std::string& name : layer.names) line += (line.empty() ? "" : "+") + name;
        c.blurred.push_back(line + (layer.is_light ? " light" : ""));
    }
    for (const CarriedLayer& left : choice->carried) c.carried[left.name] = left.why;
    return c;
}

Layout layout(std::vector<Part> parts) { return {{0, 0, 8, 8}, 1, std::move(parts), {}}; }

TEST(LayerChoice, NeverTakesTheColourOrItsDepth) {
    const Layout l = layout({part("", {"R", "G", "B", "A", "Z"})});
    EXPECT_TRUE(chosen(l, {"all"}).blurred.empty());
    EXPECT_TRUE(chosen(l, {"all"}).carried.empty());
}

TEST(LayerChoice, PutsSingleChannelsOfAPartTogetherByThree) {
    const Layout l = layout({part("rgba", {"R", "G", "B", "a1", "a2", "a3", "a4", "key.R", "key.G", "key.B"}),
                             part("mattes", {"m1", "m2"})});
    EXPECT_THAT(chosen(l, {"all"}).blurred,
                ElementsAre("rgba.a1+rgba.a2+rgba.a3", "rgba.a4", "key light", "mattes.m1+mattes.m2"));
    EXPECT_THAT(chosen(l, {"mattes"}).blurred, ElementsAre("mattes.m1+mattes.m2"));
    EXPECT_THAT(chosen(l, {"m2", "KEY"}).blurred, ElementsAre("key light", "mattes.m2"));
}

TEST(LayerChoice, LeavesAloneWhatIsNoLightAndSaysWhy) {
    Layout l =
        layout({part("", {"R", "G", "B", "Z", "ids", "N.X", "N.Y", "N.Z", "Pworld.R", "Pworld.G", "Pworld.B",
                          "mv.u", "mv.v", "Asset00.R", "Asset00.G", "Asset00.B", "chroma"}),
                part("wide", {"m"}, {-1, 0, 8, 8})});
    l.parts[0].cryptomattes = {"Asset"};
    l.parts[0].channels[4].type = ChannelType::Uint;
    l.parts[0].channels.back().x_sampling = 2;
    const Chosen c = chosen(l, {"all"});
    EXPECT_TRUE(c.blurred.empty());
    for (const char* name : {"N.X", "N.Z", "Pworld", "mv.u"})
        EXPECT_THAT(c.carried.at(name), HasSubstr("its name"));
    EXPECT_THAT(c.carried.at("Asset00"), HasSubstr("Cryptomatte"));
    EXPECT_THAT(c.carried.at("ids"), HasSubstr("whole numbers"));
    EXPECT_THAT(c.carried.at("chroma"), HasSubstr("subsampled"));
    EXPECT_THAT(c.carried.at("wide.m"), HasSubstr("beyond the colour's"));
    EXPECT_THAT(chosen(l, {"Pworld"}).blurred, ElementsAre("Pworld"));
    for (const char* name : {"Asset00", "ids", "chroma", "wide"})
        EXPECT_THAT(chosen(l, {name}).refused, HasSubstr("cannot be blurred"));
}

}  // namespace
}  // namespace petzval
