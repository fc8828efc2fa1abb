#include "engine/scatter/scatter_views.h"

#include "base/parallel.h"
#include "engine/lights/highlight_spread.h"
#include "engine/lights/highlights.h"
#include "engine/samples/complete.h"
#include "engine/samples/connectivity.h"
#include "engine/scatter/sources.h"
#include "engine/waist/memory.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace petzval::engine {
namespace {

constexpr std::size_t kBytesPerPixel = 260;
constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

struct Rank {
    const char *layer, *name;
};
constexpr std::array<Rank, 4> kRanks{{{"", "NEAREST"},
                                      {"second", "SECOND  BEHIND THE NEAREST"},
                                      {"third", "THIRD  BEHIND THESE"},
                                      {"fourth", "FOURTH  BEHIND THESE"}}};

bool holds_light(const CocSample& s) { return s.colour.a > 0 || s.colour != Rgba{}; }

std::size_t most_in_a_pixel(const Input& input, const CocSamplesView& samples) {
    std::size_t most = 0;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) {
            const auto here = samples.at(x, y);
            most = std::max(most, std::size_t(std::count_if(here.begin(), here.end(), holds_light)));
        }
    return most;
}

}  // namespace

Result<Output> run_scatter_layers(const Input& input) {
    if (const Status fits = fits_memory(input, kBytesPerPixel, "--view layers"); !fits) return fits.error();
    const CocSamples all = completed(input, connections(input.coc_px, input.threads));
    const CocSamplesView samples = all;
    const std::size_t most = most_in_a_pixel(input, samples);
    const std::size_t ranks = std::clamp<std::size_t>(most, 1, kRanks.size());
    const int width = input.width(), height = input.height();

    Output output;
    output.image = Picture(2 * width, int(ranks) * height);
    View<Rgba> atlas = output.image.view();
    for (std::size_t n = 0; n < ranks; ++n) {
        const Rect at{0, int(n) * height, width, int(n + 1) * height};
        const std::string layer = kRanks[n].layer;
        output.panels.push_back({kRanks[n].name, at, {}, layer});
        output.panels.push_back({"DEPTH LAYER  BLUE IN FRONT OF FOCUS  ORANGE BEHIND",
                                 {width, at.y0, 2 * width, at.y1},
                                 {},
                                 layer + (n > 0 ? ".depth_layer" : "depth_layer"),
                                 true});
    }
    parallel_for(height, input.threads, [&](int y) {
        for (int x = 0; x < width; ++x) {
            for (int n = 0; n < int(ranks); ++n) atlas(width + x, n * height + y) = {kNoNumber, 0, 0, 1};
            LayersOfPixel layers;
            int n = 0;
            for (const CocSample& s : samples.at(x, y)) {
                const int number = layers.next(s) / kNextLayer;
                if (!holds_light(s) || n == int(ranks)) continue;
                atlas(x, n * height + y) = s.colour;
                atlas(width + x, n * height + y).r = float(number);
                ++n;
            }
        }
    });
    if (most > ranks)
        output.warnings.push_back(
            "up to " + std::to_string(most) +
            " surfaces lie behind each other in a pixel; --view layers shows the nearest " +
            std::to_string(ranks));
    return output;
}

Result<Output> run_scatter_highlights(const Input& input) {
    if (const Status fits = fits_memory(input, kBytesPerPixel, "--view highlights"); !fits)
        return fits.error();
    CocSamples samples = completed(input, connections(input.coc_px, input.threads));
    const HighlightSplit split(input.colour, input.coc_px, {}, input.threads);
    const std::vector<Highlight> highlights =
        take_highlights(samples, split, 0, kLargestSquare, input.threads);
    if (!input.progress->advance(0.3)) return Error{ErrorCode::Cancelled, "cancelled"};

    const int width = input.width(), height = input.height();
    Output output;
    output.image = Picture(2 * width, height);
    const Rect drawn{0, 0, width, height}, taken{width, 0, 2 * width, height};
    output.panels = {{"HIGHLIGHTS  EACH DRAWN WITH ITS WHOLE KERNEL", drawn, {}, ""},
                     {"TAKEN  FROM THE SHARP PICTURE", taken, {}, "taken"}};
    for (const Highlight& h : highlights)
        for (int y = h.y; y < h.y + h.size; ++y)
            for (int x = h.x; x < h.x + h.size; ++x) {
                Rgba& pixel = output.image(width + x, y);
                pixel += h.colour, pixel.a = 1;
            }
    spread_highlights(input, HighlightKernels(input), samples, highlights, split.white(), input.colour.rect(),
                      output.image.view().part(drawn));
    if (!input.progress->advance(0.7)) return Error{ErrorCode::Cancelled, "cancelled"};
    return output;
}

}  // namespace petzval::engine
