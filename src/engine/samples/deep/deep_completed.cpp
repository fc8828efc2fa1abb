#include "engine/samples/deep/deep_completed.h"

#include "engine/samples/deep/end_of_pixel.h"
#include "engine/samples/found_surfaces.h"
#include "engine/samples/white.h"
#include "image/two_sweeps.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kAlmostOpaque = 1 - 1e-3f;

// Distance to the nearest transparent pixel (the larger of columns and rows); large if there is none.
Image<int> distance_to_emptiness(View<const Rgba> picture) {
    constexpr int kFar = 1 << 20;
    Image<int> distance(picture.width(), picture.height(), kFar);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (picture(x, y).a <= kAlmostOpaque) distance(x, y) = 0;
    two_sweeps(picture.width(), picture.height(), [&](int x, int y, int dx, int dy) {
        distance(x, y) = std::min(distance(x, y), distance(x + dx, y + dy) + 1);
    });
    return distance;
}

// Appends the estimated surfaces and lamps of pixel (x, y) behind its stated samples. A silhouette in a
// pixel as of a flat picture is separated.
void add_estimated(const EngineView& input, const FoundSurfaces& found, int x, int y, CocSamples& all) {
    const std::size_t first = all.first.back();
    const EndOfDeepPixel end(std::span(all.samples).subspan(first));
    if (is_flat_pixel(input.samples.deep, x, y)) {
        all.samples.resize(first);
        found.flat.visit(input.samples.colour, input.samples.coc_px, x, y, 1,
                         [&](Rgba c, float coc_px, float) {
                             all.samples.push_back({c, coc_px, coc_px});
                         });
    } else {
        for (const Hidden& h : found.flat.hidden.at(x, y))
            if (end.is_before(h.coc_px)) all.samples.push_back({h.colour, h.coc_px, h.coc_px});
    }
    const std::span<const HiddenLamp> lamps = found.lamps.row(y);
    const auto lamp = std::lower_bound(lamps.begin(), lamps.end(), x,
                                       [](const HiddenLamp& l, int column) { return l.x < column; });
    if (lamp != lamps.end() && lamp->x == x && end.is_before(lamp->coc_px))
        all.samples.push_back({lamp->light, lamp->coc_px, lamp->coc_px});
}

}  // namespace

CocSamples deep_completed(const EngineView& input, View<const unsigned char> connected, const Dim& dim) {
    const CocSamples stated = stated_samples(input.samples);
    const Image<int> distance = distance_to_emptiness(input.samples.colour);
    const std::shared_ptr<const FoundSurfaces> found = surfaces_and_lamps(input, connected, dim);
    const double stretch = input.lens.level(0).reach_px(1);
    CocSamples all;
    all.width = stated.width;
    all.first.reserve(stated.first.size());
    all.samples.reserve(stated.samples.size());
    for (std::size_t i = 0; i + 1 < stated.first.size(); ++i) {
        all.first.push_back(all.samples.size());
        float largest = 0;
        for (std::size_t k = stated.first[i]; k < stated.first[i + 1]; ++k) {
            all.samples.push_back(stated.samples[k]);
            largest = std::max(largest, std::abs(stated.samples[k].coc_px));
        }
        add_estimated(input, *found, int(i) % stated.width, int(i) / stated.width, all);
        const bool looks_past = double(distance.pixels()[i]) <= stretch * double(largest) + 1;
        const float open = 1 - input.samples.colour.row(int(i) / stated.width)[int(i) % stated.width].a;
        if (distance.pixels()[i] == 0 || looks_past) {
            all.samples.push_back(emptiness_behind_everything());
        } else if (open > 1e-6f) {  // a smaller rest gives no reliable colour
            all.samples.push_back(emptiness_behind_everything());
            all.samples.back().empty = open;
        }
    }
    all.first.push_back(all.samples.size());
    return all;
}

}  // namespace petzval::engine
