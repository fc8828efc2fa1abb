#include "views/plan_view.h"

#include <algorithm>
#include <span>
#include <vector>

namespace petzval::views {
namespace {

// Gives the light of a pixel that its surfaces do not explain, mostly lamps, which engines keep separate, to
// the most visible surface. Returns that light.
Rgba complete_light(std::span<DeepSample> surfaces, Rgba shown) {
    Rgba missing = shown;
    DeepSample* most = nullptr;
    float left = 1, left_there = 1;
    for (DeepSample& s : surfaces) {
        missing -= left * s.colour;
        if (!most || left * s.colour.a > left_there * most->colour.a) most = &s, left_there = left;
        left *= 1 - s.colour.a;
    }
    missing.a = 0;
    if (!most || !(left_there > 0)) return {};
    missing *= 1 / left_there;
    most->colour += missing;
    return missing;
}

// Light of a lamp that covers nothing and is not what the picture shows is hidden, and stays behind the
// surfaces for those who sort by depth.
void add_hidden_light(std::vector<DeepSample>& deep, std::size_t first, const engine::CocSample& light,
                      Rgba missing) {
    if (luminance(missing) > 0.5f * luminance(light.colour)) return;
    const float behind = deep.size() > first ? deep.back().depth : light.coc_px;
    deep.push_back({light.colour, std::max(light.coc_px, behind), std::max(light.coc_back_px, behind)});
}

}  // namespace

bool HiddenView::read(const engine::EngineView& input, const engine::CompletedPicture& completed) {
    const engine::CocSamples all = completed.all();
    const engine::CocSamplesView samples = all;
    shown_.image = Picture(input.width(), input.height());
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) shown_.image(x, y) = input.samples.colour(x, y);
    const auto samples_at = [&](int x, int y, std::vector<DeepSample>& deep) {
        const std::size_t first = deep.size();
        for (const engine::CocSample& s : samples.at(x, y))
            if (s.colour.a > 0) deep.push_back({s.colour, s.coc_px, s.coc_back_px});
        Rgba missing;
        if (input.samples.deep.empty())
            missing = complete_light(std::span(deep).subspan(first), input.samples.colour(x, y));
        for (const engine::CocSample& s : samples.at(x, y))
            if (s.colour.a == 0 && s.colour != Rgba{}) add_hidden_light(deep, first, s, missing);
    };
    shown_.hidden = DeepPicture::made_of(input.width(), input.height(), samples_at);
    return false;
}

}  // namespace petzval::views
