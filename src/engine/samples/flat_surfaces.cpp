#include "engine/samples/flat_surfaces.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/kept_surfaces.h"
#include "engine/samples/layer_shares.h"
#include "engine/samples/outlines/hidden_outlines.h"
#include "engine/samples/silhouettes/connectivity.h"
#include "engine/samples/white.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::engine {
namespace {

// Reduces the light of lamps to the light that they begin at.
Dim without_lamps(float white) {
    constexpr float kLampWhites = 4;  // 2 to 16 score alike; with 1, wide lit surfaces count
    const float least = kLampWhites * white;
    const auto reduced = [least](int, int, Rgba light) {
        const float part = least * light.a / luminance(light);
        return Rgba{part * light.r, part * light.g, part * light.b, light.a};
    };
    return {reduced, least, white};
}

FlatSurfaces surfaces_of(const EngineView& input, const LitPicture& picture, float white, bool fills) {
    const Samples& samples = input.samples;
    Workers& workers = *input.services.workers;
    const Image<unsigned char> connected = connections(samples.coc_px, workers);
    const FillRule rule = FillRule::preview();
    FlatSurfaces found;
    found.mixtures = unmix_silhouettes(picture, samples.coc_px, connected, workers, UnmixRule::draft());
    if (fills && samples.nearest_coc_px < rule.hides_before_px)
        found.hidden = fill_hidden(picture, samples.coc_px, connected, found.mixtures, samples.nearest_coc_px,
                                   samples.farthest_coc_px, rule, white, workers);
    unmix_nearer(found.mixtures, picture, found.hidden, workers);
    found.add_plate(samples.plate, picture, samples.coc_px, workers);
    return found;
}

// Gives the surfaces of a picture the light of its layer.
void take_light_of_layer(const EngineView& layer, FlatSurfaces& surfaces) {
    EngineView picture = layer;
    picture.samples.colour = layer.samples.picture;
    const View<const Rgba> colour = picture.samples.colour;
    const View<const float> coc_px = picture.samples.coc_px;
    CocSamples all;
    all.width = colour.width();
    const auto each_pixel = [&](const auto& visit) {
        for (int y = 0; y < colour.height(); ++y)
            for (int x = 0; x < colour.width(); ++x) visit(x, y);
    };
    const std::size_t pixels = std::size_t(colour.width()) * std::size_t(colour.height());
    all.first.reserve(pixels + 1), all.samples.reserve(surfaces.sample_count(pixels));
    each_pixel([&](int x, int y) {
        all.first.push_back(all.samples.size());
        surfaces.visit(colour, coc_px, x, y, 1, [&](Rgba c, float coc, float) {
            all.samples.push_back({c, coc, coc});
        });
    });
    all.first.push_back(all.samples.size());
    const SampleLayer light{layer.samples.colour, layer.samples.is_light};
    const CocSamples lit = lit_by(all, LayerShares(picture, all, {&light, 1}).of(0), light);
    std::size_t i = 0;
    each_pixel([&](int x, int y) {
        surfaces.change(colour, coc_px, x, y, [&](Rgba& c, float, float) { c = lit.samples[i++].colour; });
    });
}

}  // namespace

void FlatSurfaces::add_plate(const CleanPlate& added, const LitPicture& picture, View<const float> coc_px,
                             Workers& workers) {
    if (added.empty()) return;
    plate = added;
    unmix_before_plate(mixtures, picture, coc_px, plate, workers);
}

std::size_t FlatSurfaces::sample_count(std::size_t pixels) const {
    std::size_t count = pixels;
    for (int y = 0; y < mixtures.height(); ++y)
        mixtures.for_each_in_row(y, [&](int, const Mixture&) { count += 2; });
    for (int y = 0; y < hidden.ranges.height(); ++y)
        hidden.ranges.for_each_in_row(y, [&](int, const HiddenLayers::Range& r) { count += r.count; });
    return count;
}

std::size_t FlatSurfaces::bytes_of_layer(std::size_t pixels) const {
    constexpr std::size_t kShares = 3;  // copies of a sample's shares
    return pixels * 2 * sizeof(std::size_t) +
           sample_count(pixels) * (2 * sizeof(CocSample) + kShares * sizeof(Rgba));
}

std::size_t FlatSurfaces::bytes() const {
    std::size_t bytes = mixtures.bytes() + hidden.ranges.bytes();
    for (const auto& band : hidden.bands) bytes += band.size() * sizeof(Hidden);
    return bytes;
}

std::shared_ptr<const FlatSurfaces> preview_surfaces(const EngineView& input, bool fills) {
    const View<const Rgba> colour = input.samples.judged();
    const float white = white_of(input.all().samples.judged(), *input.services.workers);
    const Dim dim = white > 0 ? without_lamps(white) : Dim{};
    const LitPicture picture{colour, dim, input.samples.patches()};
    const auto find = [&] { return surfaces_of(input, picture, white, fills); };
    if (const CleanPlate& plate = input.samples.plate; !plate.empty()) {
        auto with_plate = std::make_shared<FlatSurfaces>(find());
        if (plate.covers) with_plate->of_plate = preview_surfaces(picture_of_plate(input), fills);
        return with_plate;
    }
    if (!input.samples.picture.empty()) {
        auto of_layer = std::make_shared<FlatSurfaces>(find());
        take_light_of_layer(input, *of_layer);
        return of_layer;
    }
    const auto found = kept_or_found(input, colour, dim, fills ? 2 : 3, [&] {
        return FoundSurfaces{find(), {}};
    });
    return {found, &found->flat};
}

int preview_reach_px(const EngineView& input) {
    const float largest = std::max(-input.samples.nearest_coc_px, input.samples.farthest_coc_px);
    return int(std::ceil(2 * largest)) + kOutlineReachPx;
}

}  // namespace petzval::engine
