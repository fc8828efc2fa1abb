// The preview engine: rings of the lens's kernels gathered at half resolution, near and far apart
// (docs/explain/published.md); each bright point with its own kernel.
#include "engine/gather/gather.h"

#include "device/device.h"
#include "engine/gather/gather_stages.h"
#include "engine/gather/plan.h"
#include "engine/gather/realtime_plan.h"
#include "engine/lights/bright_points.h"
#include "engine/lights/sprites.h"
#include "engine/samples/silhouettes/count.h"
#include "engine/waist/memory.h"
#include "engine/waist/stopwatch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

// Under job.max_memory_bytes the picture is drawn in strips of rows, each with the surrounding rows that can
// change it. Strips begin on whole tiles, cells and blocks, so no bit depends on them.
struct Strips {
    int rows = 0, halo = 0;
    std::size_t least_bytes = 0;  // of job.max_memory_bytes
};

// Bytes of cells, light, blocks and hidden surfaces, for each pixel of a strip. Measured on whole commands
// for flat pictures (docs/results/memory.md); others are less certain.
double working_bytes_per_pixel(const EngineView& input) {
    constexpr double kPerPixel = 17, kPerSilhouettePixel = 260, kMost = 106;
    constexpr double kOfLayer = 160, kOfLayerPerSilhouettePixel = 420;
    const Samples& samples = input.samples;
    const bool flat = samples.deep.empty() && samples.plate.empty() && samples.holdout.empty();
    if (!flat || input.services.max_memory_bytes == 0) return kMost;
    const double at = silhouettes_of(samples.coc_px, *input.services.workers).at;
    const double flat_bytes = kPerPixel + kPerSilhouettePixel * at;
    // (The picture asks for its layers, which are drawn after it.)
    if (samples.picture.empty() && samples.layers.empty()) return flat_bytes;
    const std::size_t results = samples.picture.empty() ? samples.layers.size() : 0;
    return flat_bytes + kOfLayer + kOfLayerPerSilhouettePixel * at + double(sizeof(Rgba) * results);
}

Strips plan_strips(const EngineView& input, const RingSizes& sizes, const BrightPoints& found) {
    constexpr std::size_t kKernelBytes = std::size_t(12) << 20;
    const int cell = 1 << (sizes.levels() - 1);
    const int unit = std::max(GatherPlan::kTile, cell);
    const auto whole_units = [unit](double rows) {
        return (int(std::min(rows, 1e6)) + unit - 1) / unit * unit;
    };
    const double largest = double(std::max(-input.samples.nearest_coc_px, input.samples.farthest_coc_px));
    Strips strips{whole_units(input.height()), whole_units(1.05 * input.lens.level(0).reach_px(largest) +
                                                           double(preview_reach_px(input)) + 4.0 * cell + 8)};
    const std::size_t row_bytes = std::size_t(working_bytes_per_pixel(input) * double(input.width())) +
                                  found.bytes_beside(1) - found.bytes_beside(0);
    const std::size_t held = held_bytes(input) + kKernelBytes + found.bytes_beside(0) +
                             sizeof(Rgba) * std::size_t(input.width()) * std::size_t(input.height());
    strips.least_bytes =
        held + std::max(std::size_t(std::min(unit + 2 * strips.halo, input.height())) * row_bytes,
                        sprites_bytes(input, found.count()));
    const std::size_t rows = (std::max(input.services.max_memory_bytes, held) - held) / row_bytes;
    if (input.services.max_memory_bytes == 0 || rows >= std::size_t(input.height())) return strips;
    strips.rows = std::max(unit, (int(rows) - 2 * strips.halo) / unit * unit);
    return strips;
}

// The estimate puts nothing behind surfaces that are behind focus. So only given samples need seams.
RingSizes ring_sizes(const EngineView& input) {
    return RingSizes(input.samples.nearest_coc_px, input.samples.farthest_coc_px,
                     ring_rule(input.options.quality), input.lens, !input.samples.deep.empty());
}

class Gather {
public:
    explicit Gather(const EngineView& input)
        : frame_(input), sizes_(ring_sizes(input)), kernels_(input.lens, sizes_) {}

    Result<Output> run(const char* engine) {
        Stopwatch watch(stages_);
        const BrightPoints found(frame_);
        if (frame_.options.lights().find) watch.lap("bright points");
        const Strips strips = plan_strips(frame_, sizes_, found);
        if (frame_.services.max_memory_bytes > 0 && frame_.services.max_memory_bytes < strips.least_bytes)
            return too_little_memory(engine, strips.least_bytes);
        Output output;
        output.canvas =
            frame_.services.device->canvas(Picture::uninitialised(frame_.width(), frame_.height()));
        for (int y = 0; y < frame_.height() && !frame_.services.progress->cancelled(); y += strips.rows)
            draw(Rect{0, y, frame_.width(), y + strips.rows}.intersected(frame_.samples.colour.rect()),
                 strips.halo, found, *output.canvas);
        if (!frame_.services.progress->cancelled() && (!found.empty() || !frame_.samples.points.empty())) {
            Stopwatch lights(stages_);
            const device::Work work = draw_sprites(frame_, found.sprites(), *output.canvas);
            lights.lap("sprites", work.bytes, work.multiply_adds);
        }
        if (frame_.services.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
        output.stages = std::move(stages_);
        return output;
    }

private:
    void draw(const Rect& rows, int halo, const BrightPoints& found, device::Target out) {
        Stopwatch watch(stages_);
        const int first = std::max(0, rows.y0 - halo), last = std::min(frame_.height(), rows.y1 + halo);
        const BrightPoints::Rest rest = found.rest(first, last);
        const EngineView& strip = rest.input();
        const GatherPlan plan = plan_gather(strip, rows.moved(0, -first), first, sizes_, kernels_);
        watch.lap("prefilter");
        const device::Control control{*strip.services.workers, *strip.services.progress,
                                      double(rows.height()) / frame_.height()};
        const auto atlas =
            strip.services.device->atlas(kernels_, plan.kernels, *strip.services.memory, control);
        watch.lap("atlas");
        if (!strip.services.progress->cancelled()) strip.services.device->gather(plan, *atlas, out, control);
        watch.lap("gather");
    }

    const EngineView& frame_;
    RingSizes sizes_;
    RingKernels kernels_;
    std::vector<StageTime> stages_;
};

}  // namespace

// The lens of a frame, kept for frames whose largest radii are equal to a pixel.
struct KeptRealtimeLens final : device::Memory::Thing {
    explicit KeptRealtimeLens(RealtimeLens made) : lens(std::move(made)) {}
    std::size_t bytes() const override { return lens.bytes(); }
    RealtimeLens lens;
};

std::shared_ptr<const RealtimeLens> kept_realtime_lens(const EngineView& input) {
    const double near_px = std::ceil(double(std::max(0.0f, -input.samples.nearest_coc_px))),
                 far_px = std::ceil(double(std::max(0.0f, input.samples.farthest_coc_px)));
    const int taps = realtime_taps(input.options.quality);
    const auto kept = input.services.memory->get<KeptRealtimeLens>(
        "realtime " + std::to_string(int(near_px)) + " " + std::to_string(int(far_px)) + " " +
            std::to_string(taps),
        [&] {
            const RealtimeZones zones = realtime_zones(input.lens.level(0), input.lens.frame.width(),
                                                       input.lens.frame.height() / input.lens.pixel_aspect);
            return std::make_shared<KeptRealtimeLens>(
                realtime_lens(input.lens.level(0), zones, near_px, far_px, taps));
        });
    return {kept, &kept->lens};
}

Result<Output> run_gather(const EngineView& input, Spare) {
    if (input.options.of<GatherOwn>().gather.stage != GatherStage::Final) return run_gather_stage(input);
    return run_gather_for("gather", input);
}

Result<Output> run_gather_for(const char* engine, const EngineView& input) {
    return Gather(input).run(engine);
}

Result<Output> run_realtime(const EngineView& input, Spare) {
    const auto start = std::chrono::steady_clock::now();
    constexpr std::size_t kBytesPerPixel = 3 * sizeof(Rgba);
    const std::size_t drawn =
        input.services.device->realtime_bytes(std::size_t(input.width()) * std::size_t(input.height()));
    if (const Status fits = fits_memory(input, kBytesPerPixel, "realtime", drawn); !fits) return fits.error();
    Output output;
    output.canvas = input.services.device->canvas(Picture::uninitialised(input.width(), input.height()));
    const RealtimePlan plan{input.samples.colour,
                            input.samples.coc_px,
                            std::max(-input.samples.nearest_coc_px, input.samples.farthest_coc_px),
                            float(input.lens.pixel_aspect),
                            kept_realtime_lens(input),
                            input.lens.frame};
    if (!input.services.progress->cancelled())
        input.services.device->draw_realtime(plan, *output.canvas,
                                             {*input.services.workers, *input.services.progress});
    if (!input.services.progress->advance(1)) return Error{ErrorCode::Cancelled, "cancelled"};
    output.stages = {
        {"realtime", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()}};
    return output;
}

}  // namespace petzval::engine
