// From a job as a user states it to the input of an engine: checks, circles of confusion, lens, sample lists.
#include "petzval/defocus.h"

#include "api/distort.h"
#include "api/engines.h"
#include "api/light_points.h"
#include "base/parallel.h"
#include "engine/samples/all_samples.h"
#include "engine/samples/deep_samples.h"
#include "engine/samples/out_of_sight.h"
#include "engine/waist/memory.h"
#include "kernel/keep/kernel_store.h"
#include "kernel/keep/remembered_lens.h"
#include "kernel/lenses/make_lens.h"
#include "views/plan_view.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace petzval {
namespace {

// Radii beyond any picture are as good as this; keeps all arithmetic finite.
constexpr float kLargestRadiusPx = 16384;

Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

float finite_radius(double radius_px) {
    if (std::isnan(radius_px)) return 0;
    return float(std::clamp(radius_px, double(-kLargestRadiusPx), double(kLargestRadiusPx)));
}

Status check_sizes(const DefocusJob& job) {
    if (job.colour.empty()) return invalid("the picture is empty");
    if (job.depth_m.width() != job.colour.width() || job.depth_m.height() != job.colour.height()) {
        std::ostringstream text;
        text << "depth is " << job.depth_m.width() << "x" << job.depth_m.height() << " and colour "
             << job.colour.width() << "x" << job.colour.height() << "; they must be of one size";
        return invalid(text.str());
    }
    for (const DeepPicture* deep : {job.deep, job.behind, job.holdout})
        if (deep && !deep->empty() &&
            (deep->width() != job.colour.width() || deep->height() != job.colour.height()))
            return invalid("the deep samples, hidden layers or holdout are not of the picture's size");
    if (job.display_window.empty()) return invalid("the display window is empty");
    if (!(job.pixel_aspect > 0) || !std::isfinite(job.pixel_aspect))
        return invalid("the pixel aspect ratio must be positive");
    if (job.points && !job.points->empty() && job.engine != "sprites")
        return invalid("given points are drawn by --engine sprites, not " + job.engine);
    if (job.scatter.view != ScatterView::Result && job.engine != "scatter")
        return invalid("layers, levels of detail and highlights are those of --engine scatter, not " +
                       job.engine);
    if (!(job.sprites.bright_factor > 0)) return invalid("--bright-factor must be more than 0");
    if (job.pupil_points < 1) return invalid("--pupil-points must be at least 1");
    return Done{};
}

// The radius of every pixel of a depth plane: by the camera, or as given.
class Radii {
public:
    static Result<Radii> make(const DefocusJob& job) {
        Radii radii;
        if (job.depth_is_coc) return radii;
        const auto coc = CircleOfConfusion::make(job.camera, job.display_window.width(), job.coc);
        if (!coc) return coc.error();
        radii.coc_ = coc.value();
        return radii;
    }
    float operator()(float depth) const {
        return finite_radius(coc_ ? coc_->radius_px(engine::finite_depth(double(depth))) : double(depth));
    }
    // 0 where radii are given.
    float at_infinity_px() const { return coc_ ? finite_radius(coc_->radius_at_infinity_px()) : 0; }
    Plane of(View<const float> depth, int threads) const {
        Plane plane = Plane::uninitialised(depth.width(), depth.height());
        parallel_for(depth.height(), threads, [&](int y) {
            for (int x = 0; x < depth.width(); ++x) plane(x, y) = (*this)(depth(x, y));
        });
        return plane;
    }

private:
    std::optional<CircleOfConfusion> coc_;
};

bool is_finite(View<const Rgba> colour, int threads) {
    std::atomic<bool> finite{true};
    parallel_for(colour.height(), threads, [&](int y) {
        bool row_finite = true;
        for (int x = 0; x < colour.width(); ++x)
            row_finite = row_finite && engine::finite_colour(colour(x, y)) == colour(x, y);
        if (!row_finite) finite = false;
    });
    return finite;
}

Picture finite_picture(View<const Rgba> colour, int threads) {
    Picture picture = Picture::uninitialised(colour.width(), colour.height());
    parallel_for(colour.height(), threads, [&](int y) {
        for (int x = 0; x < colour.width(); ++x) picture(x, y) = engine::finite_colour(colour(x, y));
    });
    return picture;
}

using LensLevels = std::vector<std::unique_ptr<const kernel::LensModel>>;

kernel::Mount mount_of(const DefocusJob& job) {
    return {job.camera, job.display_window.width(), job.display_window.height(), job.pixel_aspect};
}

// The lens as engines see it: distortion comes last, of discs and picture at once.
LensChoice lens_before_distortion(const DefocusJob& job) {
    LensChoice lens = job.lens;
    lens.distortion = 0;
    return lens;
}

// The lens on the picture's pixels, and on coarser ones for engines that work at several resolutions.
Result<LensLevels> lens_levels(const DefocusJob& job, const std::shared_ptr<kernel::KernelStore>& store) {
    constexpr std::size_t kRememberedBytes = std::size_t(48) << 20;
    constexpr int kLevels =
        13;  // the largest radius in cells of the last one is 4, fewer than any engine needs
    auto levels = kernel::make_lens_levels(lens_before_distortion(job), mount_of(job), kLevels);
    if (!levels) return levels;
    for (std::size_t i = 0; i < levels->size(); ++i) {
        auto& lens = (*levels)[i];
        if (store) lens = kernel::kept(std::move(lens), store, int(i));
        lens = kernel::remembered(std::move(lens), kRememberedBytes);
    }
    return levels;
}

// Null where nothing is to be kept. The reference engine asks for a new radius with every point of light.
std::shared_ptr<kernel::KernelStore> store_for(const DefocusJob& job) {
    if (job.kernel_cache_folder.empty() || job.engine == "reference") return nullptr;
    return std::make_shared<kernel::KernelStore>(job.kernel_cache_folder,
                                                 kernel::lens_key(lens_before_distortion(job), mount_of(job)),
                                                 job.kernel_cache_bytes);
}

// Everything that decides what an engine's kernels are; empty if it cannot be told.
std::string memory_key(const DefocusJob& job) {
    std::string key = kernel::lens_key(lens_before_distortion(job), mount_of(job));
    if (key.empty()) return key;
    const Rect &display = job.display_window, &data = job.data_window;
    for (const int n : {display.x0, display.y0, display.x1, display.y1, data.x0, data.y0, data.x1, data.y1,
                        int(job.quality)})
        key += " " + std::to_string(n);
    return key + " " + job.engine + " " + job.kernel_cache_folder;
}

const engine::Engine* find_engine(const std::string& name) {
    for (const engine::Engine& e : engine::engines())
        if (name == e.name) return &e;
    return nullptr;
}

// An edge of the data window that lies inside the display window is the end of the scene; any other edge is
// only where the render stopped.
engine::OpenEdges open_edges(const DefocusJob& job) {
    const Rect& display = job.display_window;
    const Rect& data = job.data_window;
    return {data.x0 <= display.x0, data.y0 <= display.y0, data.x1 >= display.x1, data.y1 >= display.y1};
}

}  // namespace

struct KernelMemory::Contents {
    std::string key;
    std::shared_ptr<kernel::KernelStore> store;
    LensLevels lenses;
    std::unique_ptr<engine::KeptKernels> kernels;  // of `lenses`

    // Errors: those of the lens.
    Status ready_for(const DefocusJob& job) {
        const std::string wanted = memory_key(job);
        if (!wanted.empty() && wanted == key) return Done{};
        kernels.reset(), lenses.clear(), key.clear();
        store = store_for(job);
        auto made = lens_levels(job, store);
        if (!made) return made.error();
        lenses = std::move(*made), key = wanted;
        return Done{};
    }
};

KernelMemory::KernelMemory() : contents_(std::make_unique<Contents>()) {}
KernelMemory::~KernelMemory() = default;

std::vector<std::string> engine_names() {
    std::vector<std::string> names;
    for (const engine::Engine& e : engine::engines()) names.emplace_back(e.name);
    return names;
}

Result<Plane> circle_of_confusion(const DefocusJob& job) {
    if (const Status status = check_sizes(job); !status) return status.error();
    const auto radii = Radii::make(job);
    if (!radii) return radii.error();
    return radii->of(job.depth_m, job.threads);
}

Result<DefocusReport> defocus(const DefocusJob& job) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };

    if (const Status status = check_sizes(job); !status) return status.error();
    const engine::Engine* const chosen = find_engine(job.engine);
    if (!chosen) {
        std::string known;
        for (const std::string& name : engine_names()) known += (known.empty() ? "" : ", ") + name;
        return invalid("--engine " + job.engine + " is not known; there are: " + known);
    }
    if (job.holdout && !chosen->takes_holdout)
        return invalid("--engine " + job.engine + " takes no holdout; scatter and reference do");
    const auto radii = Radii::make(job);
    if (!radii) return radii.error();
    if (job.lens.distortion != 0)  // whether this lens can have it
        if (const auto lens = kernel::make_lens(job.lens, mount_of(job)); !lens) return lens.error();
    KernelMemory of_this_job;
    KernelMemory::Contents& memory = (job.kernel_memory ? *job.kernel_memory : of_this_job).contents();
    if (const Status ready = memory.ready_for(job); !ready) return ready.error();
    const double lens_ready = seconds();

    Picture repaired;  // stays empty for a picture that needs no repair
    View<const Rgba> colour = job.colour;
    if (!is_finite(colour, job.threads)) colour = repaired = finite_picture(job.colour, job.threads);
    const Plane coc_px = radii->of(job.depth_m, job.threads);
    Progress progress(job.progress);
    engine::Input input;
    input.colour = colour;
    input.coc_px = coc_px;
    const engine::StatedPicture stated{colour, job.depth_m, job.depth_is_coc, job.deep, job.behind, *radii};
    engine::CocSamples samples = engine::all_samples(stated, job.threads);
    if (job.scatter.view != ScatterView::Layers)  // shows them all
        engine::drop_out_of_sight(samples, memory.lenses.front()->reach_px(1), job.threads);
    if (!samples.first.empty()) input.deep = samples;
    input.deep_dims_itself = job.deep && !job.deep->empty();
    const auto note_radius = [&](float radius_px) {
        input.nearest_coc_px = std::min(input.nearest_coc_px, radius_px);
        input.farthest_coc_px = std::max(input.farthest_coc_px, radius_px);
    };
    for (std::size_t i = 0; i < coc_px.size(); ++i) note_radius(coc_px.pixels()[i]);
    for (const engine::CocSample& sample : samples.samples) note_radius(sample.coc_px);
    engine::CocSamples holdout;
    if (job.holdout && !job.holdout->empty())
        input.holdout = holdout = engine::deep_samples(*job.holdout, *radii, job.depth_is_coc, job.threads);
    input.open_edges = open_edges(job);
    input.field_centre_x = 0.5 * (job.display_window.x0 + job.display_window.x1) - job.data_window.x0;
    input.field_centre_y = 0.5 * (job.display_window.y0 + job.display_window.y1) - job.data_window.y0;
    input.field_per_px =
        2 / std::hypot(job.display_window.width(), job.display_window.height() / job.pixel_aspect);
    input.pixel_aspect = job.pixel_aspect;
    input.lens_levels = memory.lenses;
    input.kept_kernels = &memory.kernels;
    input.frame_height = colour.height();
    input.quality = job.quality;
    input.pupil_points = job.pupil_points;
    input.gather = job.gather;
    input.gaussian = job.gaussian;
    input.sprites = job.sprites;
    std::vector<std::string> point_warnings;
    const std::vector<LightPoint> points = drawable_points(
        job, [&](float depth_m) { return (*radii)(depth_m); }, point_warnings);
    input.points = points;
    if (!job.depth_is_coc) input.depth_m = job.depth_m, input.focus_distance_m = job.camera.focus_distance_m;
    input.radius_at_infinity_px = radii->at_infinity_px();
    input.threads = job.threads;
    input.max_memory_bytes = job.max_memory_bytes;
    input.seed = job.seed;
    input.progress = &progress;
    const std::unique_ptr<views::PlanView> view = views::plan_view(job.scatter.view);
    if (view) {
        const std::string name = std::string("--view ") + views::name_of(job.scatter.view);
        if (const Status fits = engine::fits_memory(input, views::kBytesPerPixel, name); !fits)
            return fits.error();
        input.plan_reader = view.get();
    }
    const double prepared = seconds();

    Result<engine::Output> output = chosen->run(input);
    if (!output) return output.error();
    DefocusReport report;
    report.image = std::move(output->image);
    if (view) {
        views::Shown shown = view->take();
        report.image = std::move(shown.image), report.panels = std::move(shown.panels);
        output->warnings = std::move(shown.warnings);
    }
    if (job.lens.distortion != 0 && report.panels.empty())
        report.image = distorted(
            report.image, {input.field_centre_x, input.field_centre_y, input.field_per_px, job.pixel_aspect},
            job.lens.distortion, job.threads);
    report.engine = chosen->name;
    report.device = "cpu";
    report.lens = memory.lenses.front()->description();
    report.kernels_from_cache = memory.store ? memory.store->kernels_found() : 0;
    report.stages = {{"kernels", lens_ready},
                     {"prepare", prepared - lens_ready, coc_px.size() * (sizeof(Rgba) + 2 * sizeof(float))}};
    report.stages.insert(report.stages.end(), output->stages.begin(), output->stages.end());
    report.warnings = std::move(point_warnings);
    report.warnings.insert(report.warnings.end(), output->warnings.begin(), output->warnings.end());
    report.largest_radius_px = double(input.farthest_coc_px);
    report.smallest_radius_px = double(input.nearest_coc_px);
    return report;
}

}  // namespace petzval
