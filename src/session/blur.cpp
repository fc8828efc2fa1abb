// The blur of a frame: lens, samples, engine, distortion, report.
#include "petzval/reports/stopwatch.h"

#include "base/parallel.h"
#include "device/cpu/cpu_device.h"
#include "device/failure.h"
#include "engine/waist/memory.h"
#include "session/blurred.h"
#include "session/contents.h"
#include "session/engines.h"
#include "session/frame_part.h"
#include "session/matte_range.h"
#include "session/prepared.h"
#include "session/rendered/depth_edges.h"
#include "session/rendered/distort.h"
#include "session/rendered/empty_pixels.h"
#include "session/rendered/on_grid.h"
#include "session/windows.h"
#include "views/plan_view.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace petzval {
namespace {

// Deep samples that the caller holds; engines count the flat pictures and their own samples.
std::size_t lent_deep_bytes(const FrameRequest& request) {
    std::size_t bytes = 0;
    for (const DeepPicture* deep : {request.rendered.deep, request.rendered.behind, request.rendered.holdout})
        bytes += deep ? deep->bytes() : 0;
    return bytes;
}

Picture taken(engine::Output& output) {
    return output.canvas ? output.canvas->take() : std::move(output.image);
}

// Each layer as the picture, with its alpha.
Status run_layers(const engine::Engine& chosen, const engine::EngineView& drawn, engine::Output& output) {
    const View<const Rgba> whole = drawn.samples.colour;
    for (const engine::SampleLayer& layer : drawn.samples.layers) {
        Picture colour(drawn.width(), drawn.height());
        for (int y = 0; y < colour.height(); ++y)
            for (int x = 0; x < colour.width(); ++x) {
                colour(x, y) = layer.colour(x, y);
                colour(x, y).a = whole(x, y).a;
            }
        engine::EngineView view = drawn;
        view.samples.colour = colour;
        view.samples.picture = whole, view.samples.is_light = layer.is_light;
        view.services.surfaces = nullptr;  // within one frame they would be memory that no one expects
        Result<engine::Output> blurred = chosen.run(view, {});
        if (!blurred) return blurred.error();
        output.layers.push_back(taken(*blurred));
    }
    return Done{};
}

// The steps after an engine: distortion, and the cut to the pixels that were asked for.
void finish(DefocusReport& report, const FrameRequest& request, const Rect& asked, const Rect& seen) {
    const Rendered& rendered = request.rendered;
    const double distortion = request.look.lens.distortion;
    const auto cut = [&](Picture& image) {
        if (asked != seen) image = part_of(image, asked.moved(-seen.x0, -seen.y0));
    };
    for (std::size_t i = 0; i < report.layers.size(); ++i) {
        if (distortion != 0)
            report.layers[i] = distorted_beside(report.image, report.layers[i], rendered.layers[i].is_light,
                                                seen, rendered.place, distortion, *request.workers);
        cut(report.layers[i]);
    }
    if (report.panels.empty()) {
        if (distortion != 0)
            report.image = distorted(report.image, seen, rendered.place, distortion, *request.workers);
        cut(report.image);
    }
}

// The picture that a view shows instead of a result.
void take_view(DefocusReport& report, engine::Output& output, views::PlanView& view, const Radii& radii) {
    views::Shown shown = view.take();
    report.image = std::move(shown.image);
    report.panels = std::move(shown.panels);
    output.warnings = std::move(shown.warnings);
    report.hidden = radii.with_depths(std::move(shown.hidden));
}

// The one layer, which marks guesses, as an opaque picture 0…1; takes it out of the layers.
Picture matte_of(std::vector<Picture>& layers) {
    const Picture layer = std::move(layers.at(0));
    layers.clear();
    Picture matte(layer.width(), layer.height());
    for (std::size_t i = 0; i < matte.size(); ++i) {
        const float share = std::clamp(layer.pixels()[i].r, 0.0f, 1.0f);
        matte.pixels()[i] = {share, share, share, 1};
    }
    return matte;
}

// One blur on its way: all that is known of it before a device is chosen.
struct Blur {
    const FrameRequest& request;  // its window holds the frame's and stands on the grid
    Rect asked;                   // in its pixels
    bool is_region = false;       // what is not asked for is not to be made
    const engine::Engine& engine;
    const Radii& radii;
    MountedLens& lens;
    engine::KeptSurfaces& surfaces;
    const Stopwatch& clock;
    Progress& progress;
    std::size_t beside_bytes = 0;
};

// Given pictures that the engine passes over.
void note_passed_over(const Blur& blur, std::vector<std::string>& warnings) {
    if (!blur.engine.looks_at_front_alone) return;
    const std::string who = std::string("job.engine ") + blur.engine.name;
    const Rendered& given = blur.request.rendered;
    if (given.deep && !given.deep->empty())
        warnings.push_back(who + " flattens the deep picture: one depth in each pixel");
    if (given.behind && !given.behind->empty()) warnings.push_back("shot.behind has no effect with " + who);
}

// Fills in a report besides its pictures.
void describe(const Blur& blur, const PreparedFrame& frame, const NotingDevice& drawing, double prepared_s,
              double lens_ready_s, engine::Output& output, DefocusReport& report) {
    const engine::EngineView& whole = frame.view;
    const kernel::KernelStore* const store = blur.lens.store.get();
    report.engine = blur.engine.name;
    report.device = drawing.drawn_by();
    report.lens = blur.lens.levels.front()->description();
    report.kernels_from_cache = store ? store->kernels_found() : 0;
    const std::size_t pixels = std::size_t(whole.width()) * std::size_t(whole.height());
    report.stages = {{"kernels", lens_ready_s},
                     {"prepare", prepared_s - lens_ready_s, pixels * (sizeof(Rgba) + 2 * sizeof(float))}};
    report.stages.insert(report.stages.end(), output.stages.begin(), output.stages.end());
    report.warnings = frame.warnings;
    report.warnings.insert(report.warnings.end(), output.warnings.begin(), output.warnings.end());
    note_passed_over(blur, report.warnings);
    const FrameRequest& request = blur.request;
    if (const int missing = missing_beyond_px(request.rendered.place, request.look.lens.distortion);
        missing > 0)
        report.warnings.push_back(
            "lens.distortion shows the scene up to " + std::to_string(missing) +
            " pixels beyond the picture, where it is mirrored; render that much overscan");
    for (std::string& said : drawing.said()) report.warnings.push_back(std::move(said));
    if (store && !store->warning().empty()) report.warnings.push_back(store->warning());
    report.largest_radius_px = double(whole.samples.farthest_coc_px);
    report.smallest_radius_px = double(whole.samples.nearest_coc_px);
}

// spare: as FrameStages::begin() has it; null: not to be taken.
Result<Blurred> blurred_by(const NotingDevice& drawing, const Blur& blur, Picture* spare) {
    const double lens_ready = blur.clock.seconds();
    const FrameRequest& request = blur.request;
    PreparedFrame frame(request, blur.radii, blur.lens.levels.front()->reach_px(1));
    engine::EngineView& whole = frame.view;
    whole.lens.levels = blur.lens.levels;
    whole.lens.lamps = blur.lens.lamps;
    engine::Services& services = whole.services;
    services.device = &drawing;
    services.memory = &blur.lens.kernels;
    services.surfaces = &blur.surfaces;
    services.progress = &blur.progress;
    services.beside_bytes = blur.beside_bytes;
    const std::unique_ptr<views::PlanView> view = views::plan_view(request.view);
    if (view) {
        const std::string name = std::string("job.view ") + views::name_of(request.view);
        if (const Status fits = engine::fits_memory(whole, views::kBytesPerPixel, name); !fits)
            return fits.error();
        whole.options.own = engine::ScatterOwn{view.get()};
    }
    const Rect seen = seen_pixels(blur.asked, blur.is_region, request, whole);
    PartMemory memory;
    const bool is_part = seen != whole.samples.colour.rect();
    const engine::EngineView drawn = is_part ? part_of(whole, seen, memory) : whole;
    const bool shows_spare = spare && !spare->empty() && request.view == ScatterView::Result &&
                             spare->pixels() == whole.samples.colour.row(0);
    if (shows_spare) frame.spare.colour = std::move(*spare);
    const double prepared = blur.clock.seconds();

    const bool runs_again = blur.engine.layers == engine::Layers::OneByOne && !drawn.samples.layers.empty();
    Result<engine::Output> output =
        blur.engine.run(drawn, runs_again ? engine::Spare{} : std::move(frame.spare));
    if (!output) return output.error();
    if (runs_again)
        if (const Status done = run_layers(blur.engine, drawn, *output); !done) return done.error();
    const Rect& window = request.rendered.place.data_window;
    Blurred blurred{.report = {}, .canvas = nullptr, .seen = seen.moved(window.x0, window.y0)};
    DefocusReport& report = blurred.report;
    const bool stays_as_drawn = blur.asked == seen && request.look.lens.distortion == 0;
    if (!view && !is_matte(request) && stays_as_drawn) blurred.canvas = output->canvas;
    if (!blurred.canvas) report.image = taken(*output);
    if (view) take_view(report, *output, *view, blur.radii);
    if (is_matte(request)) report.image = matte_of(output->layers);
    report.layers = std::move(output->layers);
    finish(report, request, blur.asked, seen);
    keep_matte_range(report, request.rendered, *request.workers);
    describe(blur, frame, drawing, prepared, lens_ready, *output, report);
    return blurred;
}

// Blurs on this device; on the CPU where its memory does not hold the least part of a frame. A report says
// where a GPU that was asked for did not draw. The spare is given away on the last try alone.
Result<Blurred> blurred_by_either(const NotingDevice& drawing, const std::string& asked, const Blur& blur,
                                  Picture* spare) {
    const std::string& engine = blur.request.look.engine;
    std::string too_large;
    try {
        const bool never_fails = drawing.name() == std::string_view(device::cpu_device().name());
        auto made = blurred_by(drawing, blur, never_fails ? spare : nullptr);
        if (made && asked.starts_with("gpu") && made->report.device != drawing.name())
            made->report.warnings.push_back("session.device " + asked + " was not used; job.engine " +
                                            engine + " drew this frame on the CPU");
        return made;
    } catch (const device::Failed& failed) {
        if (failed.error.code != ErrorCode::OutOfMemory || engine == "realtime") throw;
        too_large = failed.error.message;
    }
    auto made = blurred_by(NotingDevice(device::cpu_device()), blur, spare);
    static_cast<void>(drawing.said());  // it drew nothing
    if (!made) return made;
    made->come_home();  // later stages use the first device, which cannot use the CPU's canvas
    made->report.warnings.push_back(too_large + "; the CPU made the frame");
    return made;
}

}  // namespace

Result<Blurred> Session::Contents::blur(const FrameRequest& request, const std::optional<Rect>& region,
                                        Picture* spare, Progress& progress) {
    const Stopwatch clock;
    // Kernels kept between frames are there while the frame is made. Frames beside this one may keep more
    // than they will when they end.
    const std::size_t beside = usage().kept_bytes + lent_deep_bytes(request);
    const auto engine = find_engine(request);
    if (!engine) return engine.error();
    const auto opened = opened_device();
    if (!opened) return opened.error();
    const NotingDevice drawing(**opened);
    const auto radii = Radii::make(request);
    if (!radii) return radii.error();
    const EmptyFar far = empty_far(request.rendered, *request.workers);
    const Rendered occluded = far.of(request.rendered);
    const HardDepth edges = hard_depth(occluded, request.look.depth_edges, *request.workers);
    FrameRequest on_grid = request;
    on_grid.rendered = edges.of(occluded);
    auto lens = lens_for(on_grid);
    if (!lens) return lens.error();
    const Rect data = request.rendered.place.data_window;
    const Rect window = window_for(on_grid, *radii, *(*lens)->levels.front());
    std::optional<WiderFrame> wider;
    const Rendered hard = on_grid.rendered;
    if (window != data) {
        wider.emplace(hard, window);
        on_grid.rendered = wider->rendered();
        lens = lens_for(on_grid);
        if (!lens) return lens.error();
    }
    const Rect asked = (region ? region->intersected(data) : data).moved(-window.x0, -window.y0);
    const Blur blur{on_grid,  asked, region.has_value(), **engine, *radii, **lens,
                    surfaces, clock, progress,           beside};
    auto made = blurred_by_either(drawing, settings.device, blur, spare);
    for (const std::string& warning : {far.warning, edges.what_was_done})
        if (made && !warning.empty()) made->report.warnings.push_back(warning);
    trim(most_kept_bytes());
    return made;
}

}  // namespace petzval
