#include "base/parallel.h"
#include "engine/samples/layers.h"
#include "views/plan_view.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace petzval::views {

using engine::CocSample;
using engine::CocSamplesView;
using engine::EngineView;

namespace {

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

struct Rank {
    const char *layer, *name;
};
constexpr std::array<Rank, 4> kRanks{{{"", "NEAREST"},
                                      {"second", "SECOND  BEHIND THE NEAREST"},
                                      {"third", "THIRD  BEHIND THESE"},
                                      {"fourth", "FOURTH  BEHIND THESE"}}};

bool holds_light(const CocSample& s) { return s.colour.a > 0 || s.colour != Rgba{}; }

std::size_t most_in_a_pixel(const EngineView& input, const CocSamplesView& samples) {
    std::size_t most = 0;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) {
            const auto here = samples.at(x, y);
            most = std::max(most, std::size_t(std::count_if(here.begin(), here.end(), holds_light)));
        }
    return most;
}

}  // namespace

bool LayersView::read(const EngineView& input, const engine::CompletedPicture& completed) {
    const engine::CocSamples all = completed.all();
    const CocSamplesView samples = all;
    const std::size_t most = most_in_a_pixel(input, samples);
    const std::size_t ranks = std::clamp<std::size_t>(most, 1, kRanks.size());
    const int width = input.width(), height = input.height();

    shown_.image = Picture(2 * width, int(ranks) * height);
    View<Rgba> atlas = shown_.image.view();
    for (std::size_t n = 0; n < ranks; ++n) {
        const Rect at{0, int(n) * height, width, int(n + 1) * height};
        const std::string layer = kRanks[n].layer;
        shown_.panels.push_back({kRanks[n].name, at, {}, layer});
        shown_.panels.push_back({"DEPTH LAYER  BLUE IN FRONT OF FOCUS  ORANGE BEHIND",
                                 {width, at.y0, 2 * width, at.y1},
                                 {},
                                 layer + (n > 0 ? ".depth_layer" : "depth_layer"),
                                 true});
    }
    parallel_for(height, *input.services.workers, [&](int y) {
        for (int x = 0; x < width; ++x) {
            for (int n = 0; n < int(ranks); ++n) atlas(width + x, n * height + y) = {kNoNumber, 0, 0, 1};
            engine::LayersOfPixel layers(!input.samples.deep.empty());
            int n = 0;
            for (const CocSample& s : samples.at(x, y)) {
                const int number = layers.next(s).layer / engine::kNextLayer;
                if (!holds_light(s) || n == int(ranks)) continue;
                atlas(x, n * height + y) = s.colour;
                atlas(width + x, n * height + y).r = float(number);
                ++n;
            }
        }
    });
    if (most > ranks)
        shown_.warnings.push_back("up to " + std::to_string(most) +
                                  " surfaces overlap in a pixel; job.view layers shows the nearest " +
                                  std::to_string(ranks));
    return false;
}

}  // namespace petzval::views
