// The final-frame engine: complete, split, spread by levels, composite by lens area
// (docs/explain/scatter.md).
#include "engine/scatter/scatter.h"

#include "base/parallel.h"
#include "device/device.h"
#include "engine/lights/highlights.h"
#include "engine/samples/behind/smooth.h"
#include "engine/samples/complete.h"
#include "engine/samples/deep/lens_area.h"
#include "engine/samples/lamps/lamps.h"
#include "engine/samples/layer_shares.h"
#include "engine/samples/outlines/hidden_outlines.h"
#include "engine/samples/silhouettes/connectivity.h"
#include "engine/scatter/guessed_shares.h"
#include "engine/scatter/layer_highlights.h"
#include "engine/scatter/peak_memory.h"
#include "engine/scatter/plan_reader.h"
#include "engine/waist/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

// Sizes of the inputs and outputs of stages.
template <typename T>
std::size_t bytes_of(View<T> pixels) {
    return std::size_t(pixels.width()) * std::size_t(pixels.height()) * sizeof(T);
}

std::size_t bytes_of(const CocSamples& samples) {
    return samples.first.size() * sizeof(std::size_t) + samples.samples.size() * sizeof(CocSample);
}

std::size_t bytes_of(const ScatterPlan& plan) {
    std::size_t bytes = plan.arrivals.size() * sizeof(Arrival) + plan.shares.size() * sizeof(float);
    for (const SourceArray& level : plan.levels) bytes += level.sources.size() * sizeof(Source);
    return bytes;
}

// Frames are done in strips of rows, each with as many rows around it as can influence it, so that memory is
// bounded; strips begin on whole tiles and whole cells of every level, so that they change no bit.
struct StripPlan {
    int rows = 0, halo = 0;
};

// Working memory of a strip. Without layers, 80 to 120 bytes a pixel were measured on the built-in scenes as
// flat pictures; with two layers 185 to 494, and that beside those of the layers grew with the samples.
double working_bytes_per_pixel(const EngineView& input) {
    constexpr double kPixel = 20, kDeepSample = 110, kSampleBesideLayers = 150;
    const CocSamplesView& deep = input.samples.deep;
    const std::size_t layers = input.samples.layers.size();
    const double pixels = double(input.width()) * double(input.height());
    const double stated = std::max(1.0, double(deep.samples().size()) / pixels);
    if (layers == 0) return kPixel + kDeepSample * stated;
    const double samples = samples_per_pixel(input);
    const double beside = deep.empty() ? kSampleBesideLayers * (samples - 1) : kDeepSample * stated;
    return kPixel + beside + layer_bytes_per_pixel(layers, samples);
}
// Kernels, tables, code: of aberrated lenses 20M more than of the ideal one.
constexpr std::size_t kFixedWorkingBytes = std::size_t(56) << 20;
// Strips of wide frames that are narrower are mostly halo.
constexpr std::size_t kDefaultWorkingBytes = std::size_t(2000) << 20;

Error too_little(const EngineView& input, std::size_t held, std::size_t of_strip, std::size_t at_once,
                 std::size_t rows) {
    const auto mib = [](std::size_t bytes) { return std::to_string(bytes >> 20); };
    const std::size_t in_strips = held + of_strip;
    const std::string why = at_once <= in_strips
                                ? "M"
                                : "M, " + mib(held) + "M of them whole pictures, the rest a strip of " +
                                      std::to_string(rows) + " rows, as high as the blur reaches";
    return Error{ErrorCode::OutOfMemory, "job.max_memory_bytes " + mib(input.services.max_memory_bytes) +
                                             "M is too little for this picture and blur; it takes at least " +
                                             mib(std::min(at_once, in_strips) + (std::size_t(1) << 20)) +
                                             why};
}

Result<StripPlan> plan_strips(const EngineView& input, const LevelRule& rule, const ScatterKernels& kernels,
                              const HighlightSplit& split, bool has_spare) {
    const double largest =
        std::max(std::abs(input.samples.nearest_coc_px), std::abs(input.samples.farthest_coc_px));
    const int coarsest = kernels.coarsest_for(int(std::ceil(rule.position(float(largest)))));
    const int unit = std::max(ScatterPlan::kTile, 1 << coarsest);
    const auto whole_units = [unit](double rows) {
        return (int(std::min(rows, 1e6)) + unit - 1) / unit * unit;
    };
    StripPlan plan;
    // Rows around a row that can change it: sources that spread onto it, and the neighbourhood that decides
    // which surfaces lie hidden there. The other end of a lamp is as far again.
    constexpr int kLookedAtPx = std::max(2 * kWidestLampPx + 16, kOutlineReachPx + kSmoothReachPx);
    const double reach = std::min(input.lens.level(0).reach_px(largest), double(input.height()));
    plan.halo = whole_units(1.2 * reach + 4.0 * (1 << coarsest) +
                            2 * std::min(largest, double(input.height())) + kLookedAtPx);
    const std::size_t pixels = std::size_t(input.width()) * std::size_t(input.height());
    // The caller's colour and depth, the radii and the result exist besides.
    // Each layer has a colour and a result.
    const std::size_t held = pixels * (2 * sizeof(Rgba) + 2 * sizeof(float)) +
                             input.samples.layers.size() * pixels * 2 * sizeof(Rgba) + kFixedWorkingBytes +
                             input.services.beside_bytes;
    std::size_t working = kDefaultWorkingBytes;
    if (input.services.max_memory_bytes > 0)
        working = input.services.max_memory_bytes > held ? input.services.max_memory_bytes - held : 0;
    const auto row_bytes = std::size_t(working_bytes_per_pixel(input) * double(input.width()));
    const std::size_t rows = working / row_bytes;
    const std::size_t at_once =
        input.services.max_memory_bytes > 0 ? bytes_at_once(input, rule, split, has_spare) : 0;
    if (rows >= std::size_t(input.height()) || at_once < input.services.max_memory_bytes) {
        plan.rows = whole_units(input.height());
        return plan;
    }
    const std::ptrdiff_t own = std::ptrdiff_t(rows) - 2 * std::ptrdiff_t(plan.halo);
    plan.rows = int(std::max<std::ptrdiff_t>(unit, own / unit * unit));
    const std::size_t least = std::min(std::size_t(unit + 2 * plan.halo), std::size_t(input.height()));
    if (input.services.max_memory_bytes > 0 && rows < least)
        return too_little(input, held, least * row_bytes, at_once, least);
    return plan;
}

HighlightRule bright_rule(const EngineView& frame) {
    return {.same_pixel_px = frame.samples.deep_dims_itself ? same_pixel_px(frame.lens.pixel_aspect) : 0,
            .hidden_known = frame.samples.are_stated()};
}

// A run over the strips of a frame: each is completed, split, planned and drawn.
class ScatterRun {
public:
    ScatterRun(const EngineView& frame, Spare spare, Stopwatch& watch)
        : frame_(frame),
          spare_(std::move(spare)),
          watch_(watch),
          rule_(level_rule(frame)),
          kernels_(frame.services.memory->get<ScatterKernels>(
              ScatterKernels::name_for(rule_),
              [&] { return std::make_shared<ScatterKernels>(frame.lens, rule_); })),
          highlight_kernels_(frame.services.memory->get<HighlightKernels>(
              "highlights", [&] { return std::make_shared<HighlightKernels>(frame); })),
          split_(frame, bright_rule(frame)) {
        watch_.lap("split", bytes_of(frame.samples.colour) + bytes_of(frame.samples.coc_px));
    }
    Result<StripPlan> strips() const {
        return plan_strips(frame_, rule_, *kernels_, split_, !spare_.colour.empty());
    }
    // Memory of the whole frame; one strip may reuse that of the colour, which is no longer needed.
    Picture memory_for_result(bool one_strip) {
        if (one_strip && spare_.colour.rect() == frame_.samples.colour.rect())
            return std::move(spare_.colour);
        return Picture::uninitialised(frame_.width(), frame_.height());
    }

    // Draws `rows` of the frame. `share`: fraction of the progress.
    void draw(const Rect& rows, int halo, double share, Output& out) {
        const int first = std::max(0, rows.y0 - halo);
        const EngineView input = frame_.rows(first, std::min(frame_.height(), rows.y1 + halo));
        share /= double(1 + input.samples.layers.size());
        Strip strip = complete(input, rows, first);
        const CocSamples seen = input.samples.layers.empty() ? CocSamples{} : strip.completed->all();
        planned(strip, [&](const PlannedStrip& p, ScatterPlan& plan) {
            const bool one_strip = rows == frame_.samples.colour.rect();
            if (input.samples.layers.empty()) let_go(strip, one_strip);
            if (!out.canvas) out.canvas = frame_.services.device->canvas(memory_for_result(one_strip));
            draw(p, share, *out.canvas);
            draw_layers(strip, p, plan, seen, share, out.layers);
        });
    }
    void show(PlanReader& reader) {
        Strip strip = complete(frame_, frame_.samples.colour.rect(), 0);
        if (!reader.read(frame_, *strip.completed)) return;
        planned(strip, [&](const PlannedStrip& p, ScatterPlan&) { reader.read(p); });
    }

private:
    // Rows of the frame while they are worked on; `rows` of them will be drawn.
    struct Strip {
        const EngineView& input;
        Rect rows;  // counted from the strip's first row
        int first_row = 0;
        Image<unsigned char> connected;
        std::shared_ptr<const CompletedPicture> completed;
        std::size_t sample_bytes = 0;  // bytes of all samples
        CocSamples base;               // all light except highlights; only if there are layers
    };

    Strip complete(const EngineView& input, const Rect& rows, int first_row) {
        Strip strip{input,     {0, rows.y0 - first_row, rows.width(), rows.y1 - first_row},
                    first_row, connections(input.samples.coc_px, *input.services.workers),
                    nullptr,   0,
                    {}};
        strip.completed = std::make_shared<CompletedPicture>(
            input, strip.connected,
            Dim{[&](int x, int y, Rgba light) { return split_.dim(x, first_row + y, light); },
                split_.least_of_lamps(), split_.white(), split_.name() + std::uint64_t(first_row)});
        strip.sample_bytes = strip.completed->sample_count() * sizeof(CocSample) +
                             std::size_t(input.width()) * std::size_t(input.height()) * sizeof(std::size_t);
        watch_.lap("complete",
                   bytes_of(input.samples.colour) + bytes_of(input.samples.coc_px) + strip.connected.bytes());
        return strip;
    }

    // Intermediate results between a strip's samples and its sources.
    struct Found {
        explicit Found(const EngineView& strip)
            : highlights(std::size_t(strip.height() / SampleSource::kRows + 1)),
              casters(strip.width(), strip.height()) {}
        std::vector<std::vector<Highlight>> highlights;  // per row
        ShadowCasters casters;
    };

    // The samples of a strip's rows, less the highlights.
    void base_of(const Strip& strip, const CompletedPicture& completed, int y0, int y1, Found& found,
                 CocSamples& rows) const {
        completed.rows(y0, y1, rows);
        std::vector<Highlight>& taken = found.highlights[std::size_t(y0 / SampleSource::kRows)];
        taken = take_highlights(rows, split_, strip.first_row + y0, kLargestSquare,
                                *strip.input.services.workers);
        for (Highlight& h : taken) h.y += y0;
        if (strip.input.samples.deep_dims_itself) share_lens_area(rows, *strip.input.services.workers);
        found.casters.add(y0, rows);
    }
    // The samples without highlights. They are held at once only for layers; otherwise each is made when
    // its row is asked for.
    SampleSource base_of(Strip& strip, Found& found) const {
        const std::shared_ptr<const CompletedPicture> completed = std::move(strip.completed);
        const int width = strip.input.width(), height = strip.input.height();
        if (!strip.input.samples.layers.empty()) {
            base_of(strip, *completed, 0, height, found, strip.base);
            return strip.base;
        }
        return {width, height, completed->largest_coc_px(),
                [this, &strip, completed, &found](int y0, int y1, CocSamples& rows) {
                    base_of(strip, *completed, y0, y1, found, rows);
                }};
    }

    // use(the strip, planned; its plan, which may be lit anew).
    template <typename Use>
    void planned(Strip& strip, const Use& use) {
        Found found(strip.input);
        ScatterPlan plan = plan_of(strip, base_of(strip, found));
        std::vector<Highlight> highlights;
        for (const auto& rows : found.highlights)
            highlights.insert(highlights.end(), rows.begin(), rows.end());
        use({strip.input, plan, *kernels_, highlights, found.casters, *highlight_kernels_, split_.white()},
            plan);
    }

    ScatterPlan plan_of(const Strip& strip, SampleSource base) {
        ScatterPlan plan = make_plan(strip.input, std::move(base), strip.connected, strip.rows,
                                     strip.first_row, rule_, *kernels_);
        watch_.lap("sources", 2 * strip.sample_bytes + bytes_of(strip.input.samples.coc_px) +
                                  strip.connected.bytes() + bytes_of(plan));
        return plan;
    }

    void draw(const PlannedStrip& p, double share, device::Target out) {
        const EngineView& strip = p.input;
        const device::Device& device = *strip.services.device;
        const device::Control control{*strip.services.workers, *strip.services.progress, 0.9 * share};
        const auto atlas = device.atlas(*kernels_, p.scatter.kernels, *strip.services.memory, control);
        watch_.lap("atlas");
        if (!strip.services.progress->cancelled())
            lap("spread", device.composite(p.scatter, *atlas, out, control));
        lap("highlights", draw_lights(p, out));
        strip.services.progress->advance(0.1 * share);
    }

    // Releases the data that nothing needs once the only plan of a strip is made.
    void let_go(Strip& strip, bool is_all) {
        strip.connected = {};
        if (is_all && spare_.coc_px.rect() == frame_.samples.colour.rect()) spare_.coc_px = {};
    }

    // Draws the same plan with a layer's light instead of the beauty's.
    void draw_layers(const Strip& strip, const PlannedStrip& beauty, ScatterPlan& plan,
                     const CocSamples& seen, double share, std::vector<Picture>& out) {
        const std::span<const SampleLayer> layers = strip.input.samples.layers;
        if (layers.size() == 1 && layers[0].marks_guesses)
            return draw_layer(strip, beauty, plan, guessed_shares(strip.input, seen), layers[0], share,
                              out[0]);
        for (std::size_t first = 0; first < layers.size(); first += LayerShares::kAtOnce) {
            const auto together =
                layers.subspan(first, std::min(LayerShares::kAtOnce, layers.size() - first));
            if (frame_.services.progress->cancelled()) return;
            const LayerShares shares(strip.input, seen, together);
            watch_.lap("layers", bytes_of(seen) * (1 + together.size()));
            for (std::size_t i = 0; i < together.size() && !frame_.services.progress->cancelled(); ++i)
                draw_layer(strip, beauty, plan, shares.of(i), together[i], share, out[first + i]);
        }
    }
    void draw_layer(const Strip& strip, const PlannedStrip& beauty, ScatterPlan& plan,
                    const std::vector<Rgba>& shares, const SampleLayer& layer, double share, View<Rgba> out) {
        const CocSamples base = lit_by(strip.base, shares, layer);
        const std::vector<Highlight> highlights = lit_by(beauty.highlights, strip.base, shares, layer);
        relight(plan, strip.input, base, strip.connected, *kernels_);
        watch_.lap("layers", 3 * bytes_of(base));
        draw({strip.input, plan, *kernels_, highlights, beauty.casters, *highlight_kernels_, split_.white(),
              &beauty.highlights},
             share, out);
    }

    void lap(const char* stage, device::Work work) { watch_.lap(stage, work.bytes, work.multiply_adds); }

    const EngineView& frame_;
    Spare spare_;
    Stopwatch& watch_;
    LevelRule rule_;
    std::shared_ptr<const ScatterKernels> kernels_;
    std::shared_ptr<const HighlightKernels> highlight_kernels_;
    HighlightSplit split_;
};

}  // namespace

device::Work draw_lights(const PlannedStrip& strip, device::Target out) {
    if (strip.highlights.empty()) return {};
    const EngineView& input = strip.input;
    const device::Control control{*input.services.workers, *input.services.progress};
    LightsPlanner planner(input, strip.highlight_kernels, strip.casters, strip.highlights, strip.white,
                          strip.scatter.rows, strip.scatter.first_row, strip.asked_by);
    device::Work work;
    LightsPlan plan;
    while (!input.services.progress->cancelled() && planner.next(plan)) {
        const auto atlas = input.services.device->atlas(strip.highlight_kernels, plan.kernels,
                                                        *input.services.memory, control);
        if (!input.services.progress->cancelled())
            work += input.services.device->add_lights(plan, *atlas, out, control);
    }
    return work;
}

Result<Output> run_scatter(const EngineView& input, Spare spare) {
    Output output;
    Stopwatch watch(output.stages);
    ScatterRun run(input, std::move(spare), watch);
    if (input.options.of<ScatterOwn>().plan_reader) {
        run.show(*input.options.of<ScatterOwn>().plan_reader);
        if (input.services.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
        return output;
    }
    const Result<StripPlan> strips = run.strips();
    if (!strips) return strips.error();
    for (std::size_t i = 0; i < input.samples.layers.size(); ++i)
        output.layers.push_back(Picture::uninitialised(input.width(), input.height()));
    for (int y = 0; y < input.height() && !input.services.progress->cancelled(); y += strips->rows) {
        const Rect rows =
            Rect{0, y, input.width(), y + strips->rows}.intersected(input.samples.colour.rect());
        run.draw(rows, strips->halo, double(rows.height()) / input.height(), output);
    }
    if (input.services.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    return output;
}

}  // namespace petzval::engine
