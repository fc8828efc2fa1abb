#include "files/exr/layers.h"

#include "petzval/names.h"

#include "base/parallel.h"
#include "files/exr/pixels.h"
#include "files/wording.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace petzval {
namespace {

using Channels = std::array<float Rgba::*, 4>;
constexpr Channels kChannels{&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a};

// All layers of one part, in one pass over it.
Status read_part(const ExrFile& exr, std::size_t part, const std::vector<LayerChoice>& layers, Frame& frame) {
    const Rect data = exr.layout.parts[part].data_window, &asked = frame.place.data_window;
    std::vector<Picture> pictures(layers.size());
    std::vector<FloatTarget> targets;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (layers[i].part != part) continue;
        pictures[i] = Picture(data.width(), data.height());
        for (std::size_t c = 0; c < 4; ++c)
            if (!layers[i].channels[c].empty())
                targets.push_back({layers[i].channels[c], &(pictures[i].pixels()->*kChannels[c]), 4,
                                   4 * std::ptrdiff_t(data.width())});
    }
    if (targets.empty()) return Done{};
    if (Status s = read_floats(exr, part, targets); !s) return s;
    for (std::size_t i = 0; i < layers.size(); ++i)
        if (!pictures[i].empty())
            frame.layers[i].colour =
                data == asked ? std::move(pictures[i]) : through_window(pictures[i], data, asked, Rgba{});
    return Done{};
}

std::size_t replace_non_finite(Picture& picture) {
    std::size_t broken = 0;
    for (std::size_t i = 0; i < picture.size(); ++i)
        for (const auto channel : kChannels) broken += made_finite(picture.pixels()[i].*channel);
    return broken;
}

bool has_alpha_of(const Picture& colour, const Picture& layer) {
    return std::equal(colour.pixels(), colour.pixels() + colour.size(), layer.pixels(),
                      [](Rgba a, Rgba b) { return a.a == b.a; });
}

// True if the colour may be the sum of this layer and others: a layer that exceeds the colour is not light.
// Grain and negative lobes of filters are tolerated.
bool may_be_light(const Picture& colour, const Picture& layer) {
    constexpr double kMost = 0.02;  // of the pixels that the layer has
    constexpr float kOver = 1.5f, kNothing = 1e-3f;
    std::size_t there = 0, too_much = 0;
    for (std::size_t i = 0; i < layer.size(); ++i) {
        const Rgba l = layer.pixels()[i], c = colour.pixels()[i];
        const float most = std::max({l.r, l.g, l.b});
        if (!(most > kNothing)) continue;
        ++there;
        too_much +=
            l.r > kOver * c.r + kNothing || l.g > kOver * c.g + kNothing || l.b > kOver * c.b + kNothing;
    }
    return double(too_much) <= kMost * double(there);
}

// Values where the colour has nothing that could carry them.
void warn_of_lost_values(const FrameLayer& layer, Frame& frame) {
    constexpr float kNothing = 1e-3f;
    std::size_t lost = 0;
    for (std::size_t i = 0; i < layer.colour.size(); ++i) {
        const Rgba l = layer.colour.pixels()[i], c = frame.colour.pixels()[i];
        const Rgba by = layer.is_light ? c : Rgba{c.a, c.a, c.a, c.a};
        const auto gone = [](float value, float of) { return std::abs(value) > kNothing && of == 0; };
        lost += gone(l.r, by.r) || gone(l.g, by.g) || gone(l.b, by.b);
    }
    if (lost > 0)
        frame.warnings.push_back("layers: " + listed(layer.names) + " have values in " +
                                 std::to_string(lost) + " pixels where the colour has no " +
                                 (layer.is_light ? "light" : "coverage") + "; the blur leaves them out");
}

}  // namespace

void describe_layers(const LayersChoice& choice, Frame& frame) {
    frame.layers_carried = choice.carried;
    std::vector<std::string> names;
    for (const LayerChoice& layer : choice.layers)
        for (const std::string& name : layer.names)
            names.push_back(layer.spectrum ? name + " (" + name_of(*layer.spectrum) + ")" : name);
    if (names.empty()) return;
    frame.detected.push_back("layers: " + listed(names) + " are blurred with the colour");
    std::map<std::string, std::vector<std::string>> by_reason;
    for (const CarriedLayer& left : choice.carried) by_reason[left.why].push_back(left.name);
    for (const auto& [why, left] : by_reason)
        frame.detected.push_back("layers: " + listed(left) + " stay as they are: " + why);
}

Status read_layers(const ExrFile& exr, std::vector<LayerChoice>& layers, Frame& frame) {
    frame.layers.resize(layers.size());
    for (std::size_t part = 0; part < exr.layout.parts.size(); ++part)
        if (Status s = read_part(exr, part, layers, frame); !s) return s;
    const std::size_t chosen = layers.size();
    for (std::size_t i = 0; i < chosen; ++i) {
        FrameLayer& read = frame.layers[i];
        frame.non_finite_colour += replace_non_finite(read.colour);
        read.names = layers[i].names;
        read.is_light = layers[i].is_light && may_be_light(frame.colour, read.colour);
        read.spectrum = layers[i].spectrum;
        if (read.spectrum && !read.is_light)
            return Error{ErrorCode::InvalidArgument,
                         "read.layers " + read.names.front() +
                             " names a lamp, but holds more than the colour: it is not a share of its light",
                         "read.layers"};
        if (layers[i].channels[3].empty() || has_alpha_of(frame.colour, read.colour)) continue;
        LayerChoice alpha{{read.names.front() + ".A"}, layers[i].part, {layers[i].channels[3]}};
        FrameLayer own{alpha.names, Picture(read.colour.width(), read.colour.height()), false};
        for (std::size_t p = 0; p < own.colour.size(); ++p)
            own.colour.pixels()[p].r = read.colour.pixels()[p].a;
        layers[i].channels[3].clear();
        layers.push_back(std::move(alpha));
        frame.layers.push_back(std::move(own));
    }
    for (FrameLayer& layer : frame.layers) warn_of_lost_values(layer, frame);
    for (FrameLayer& layer : frame.layers)
        for (std::size_t p = 0; p < layer.colour.size(); ++p)
            layer.colour.pixels()[p].a = frame.colour.pixels()[p].a;
    return Done{};
}

}  // namespace petzval
