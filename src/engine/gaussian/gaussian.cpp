// The draft engine: light shared between Gaussian blurs, each half as wide as the next
// (docs/explain/published.md). Always round, whatever the lens: it has the disc's second moment, not its
// shape.
#include "engine/gaussian/gaussian.h"

#include "device/device.h"
#include "engine/gaussian/plan.h"
#include "engine/waist/memory.h"
#include "engine/waist/stopwatch.h"

#include <algorithm>

namespace petzval::engine {
namespace {

// Bytes of the result, the layers, copies for the blur of one layer at a time, and the estimated background;
// per worker a tile of each narrow blur.
std::size_t working_bytes(const GaussianPlan& plan, const EngineView& input) {
    constexpr std::size_t kOfCell = sizeof(Rgba) + sizeof(float), kTilePixels = std::size_t(288) * 96;
    const std::size_t pixels = std::size_t(input.width()) * std::size_t(input.height());
    std::size_t layers = 0, largest = 0, tiles = 1;
    for (const Blur& blur : plan.blurs) {
        const std::size_t bytes = (kOfCell >> (2 * blur.level)) + 1;
        if (blur.is_narrow())
            ++tiles;
        else
            layers += bytes, largest = std::max(largest, bytes);
    }
    // (The picture asks for its layers, which are drawn after it.)
    const bool is_layer = !input.samples.picture.empty();
    const std::size_t results = is_layer ? 0 : input.samples.layers.size() * pixels * sizeof(Rgba);
    const std::size_t of_layers =
        is_layer || results > 0 ? plan.surfaces->bytes_of_layer(pixels) + results : 0;
    return pixels * (sizeof(Rgba) + layers + largest) + plan.surfaces->bytes() + of_layers +
           std::size_t(input.services.workers->width()) * tiles * kOfCell * kTilePixels;
}

}  // namespace

std::size_t least_gaussian_bytes(const EngineView& input) {
    return held_bytes(input) + working_bytes(plan_gaussian(input), input);
}

Result<Output> run_gaussian(const EngineView& input, Spare) {
    Output output;
    Stopwatch stopwatch(output.stages);
    const GaussianView view = input.options.of<GaussianOwn>().gaussian.view;
    const float largest_px = std::max(-input.samples.nearest_coc_px, input.samples.farthest_coc_px);
    const bool is_sharp =
        view == GaussianView::Sharp || (largest_px <= kWithinPixelPx && view == GaussianView::Result);
    const GaussianPlan plan = is_sharp ? GaussianPlan() : plan_gaussian(input);
    if (const Status fits = fits_memory(input, 0, "gaussian", working_bytes(plan, input)); !fits)
        return fits.error();
    stopwatch.lap("plan");
    output.canvas = input.services.device->canvas(Picture::uninitialised(input.width(), input.height()));
    if (is_sharp || plan.blurs.empty()) {
        const View<Rgba> out = output.canvas->view();
        for (int y = 0; y < input.height(); ++y)
            std::copy_n(input.samples.colour.row(y), input.width(), out.row(y));
        return output;
    }
    const auto passed = [&](const char* pass) { stopwatch.lap(pass); };
    input.services.device->mix(plan, *output.canvas,
                               {*input.services.workers, *input.services.progress, 0, passed});
    stopwatch.lap("mix");
    if (!input.services.progress->advance(1)) return Error{ErrorCode::Cancelled, "cancelled"};
    return output;
}

}  // namespace petzval::engine
