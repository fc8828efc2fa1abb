#include "session/frame.h"

#include "base/parallel.h"
#include "engine/samples/all_samples.h"
#include "engine/samples/deep_samples.h"
#include "engine/samples/out_of_sight.h"
#include "session/light_points.h"

#include <algorithm>
#include <atomic>
#include <cmath>
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

bool is_finite(View<const Rgba> colour, Workers& workers) {
    std::atomic<bool> finite{true};
    parallel_for(colour.height(), workers, [&](int y) {
        bool row_finite = true;
        for (int x = 0; x < colour.width(); ++x)
            row_finite = row_finite && engine::finite_colour(colour(x, y)) == colour(x, y);
        if (!row_finite) finite = false;
    });
    return finite;
}

Picture finite_picture(View<const Rgba> colour, Workers& workers) {
    Picture picture = Picture::uninitialised(colour.width(), colour.height());
    parallel_for(colour.height(), workers, [&](int y) {
        for (int x = 0; x < colour.width(); ++x) picture(x, y) = engine::finite_colour(colour(x, y));
    });
    return picture;
}

// An edge of the data window that lies inside the display window is the end of the scene; any other edge is
// only where the render stopped.
engine::OpenEdges open_edges(const DefocusJob& job) {
    const Rect& display = job.place.display_window;
    const Rect& data = job.place.data_window;
    return {data.x0 <= display.x0, data.y0 <= display.y0, data.x1 >= display.x1, data.y1 >= display.y1};
}

}  // namespace

Result<Radii> Radii::make(const DefocusJob& job) {
    Radii radii;
    if (has_radii(job)) return radii;
    const auto coc = CircleOfConfusion::make(job.camera, job.place.display_window.width(), job.coc);
    if (!coc) return coc.error();
    radii.coc_ = coc.value();
    return radii;
}

float Radii::operator()(float depth) const {
    return finite_radius(coc_ ? coc_->radius_px(engine::finite_depth(double(depth))) : double(depth));
}

DeepPicture Radii::with_depths(DeepPicture of_radii) const {
    if (!coc_) return of_radii;
    for (DeepSample& s : of_radii.samples())
        for (float* depth : {&s.depth_m, &s.depth_back_m})
            *depth = float(coc_->depth_from_radius_m(double(*depth)));
    return of_radii;
}

float Radii::at_infinity_px() const { return coc_ ? finite_radius(coc_->radius_at_infinity_px()) : 0; }

Plane Radii::of(View<const float> depth, Workers& workers) const {
    Plane plane = Plane::uninitialised(depth.width(), depth.height());
    parallel_for(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) plane(x, y) = (*this)(depth(x, y));
    });
    return plane;
}

Status check_job(const DefocusJob& job) {
    if (job.colour.empty()) return invalid("the picture is empty");
    if (!job.depth_m.empty() && !job.coc_px.empty())
        return invalid("depth and radii are both given; one says what blurs");
    const View<const float> depth = depth_or_radii(job);
    if (depth.width() != job.colour.width() || depth.height() != job.colour.height()) {
        std::ostringstream text;
        text << "depth is " << depth.width() << "x" << depth.height() << " and colour " << job.colour.width()
             << "x" << job.colour.height() << "; they must be of one size";
        return invalid(text.str());
    }
    for (const DeepPicture* deep : {job.deep, job.behind, job.holdout})
        if (deep && !deep->empty() &&
            (deep->width() != job.colour.width() || deep->height() != job.colour.height()))
            return invalid("the deep samples, hidden layers or holdout are not of the picture's size");
    for (const ColourLayer& layer : job.layers)
        if (layer.colour.width() != job.colour.width() || layer.colour.height() != job.colour.height())
            return invalid("the layers are not of the picture's size");
    if (!job.mask.empty() &&
        (job.mask.width() != job.colour.width() || job.mask.height() != job.colour.height()))
        return invalid("shot.mask is not of the picture's size");
    if (!job.layers.empty() && job.scatter.view != ScatterView::Result)
        return invalid("shot.layers are blurred for results, not for views");
    if (Status place = check(job.place); !place) return place;
    if (job.points && !job.points->empty() && job.engine != "sprites")
        return invalid("given points are drawn by job.engine sprites, not " + job.engine);
    if (job.scatter.view != ScatterView::Result && job.engine != "scatter")
        return invalid(
            "layers, levels of detail, highlights and what is hidden are those of job.engine "
            "scatter, not " +
            job.engine);
    if (job.scatter.view == ScatterView::Hidden && !(job.coc == CocControls{}))
        return invalid(
            "hidden surfaces are written by their depth, which radii tell that are not changed by "
            "focus.range_m, focus.near_scale, focus.far_scale or focus.max_radius_px");
    if (job.gaussian.along_ray && has_radii(job))
        return invalid("gaussian.depth_along ray counts metres; radii were given");
    if (!(job.gather.pixel_size_px >= 0 && job.gather.pixel_size_px < 1))
        return invalid("gather.pixel_size_px must be 0 or more, and less than 1");
    if (!(job.gather.tap_offset > 0 && job.gather.tap_offset <= 4))
        return invalid("gather.tap_offset must be more than 0, and at most 4");
    if (const double from = job.gather.blurred_px.value_or(1); !(from >= 1 && std::isfinite(from)))
        return invalid("gather.blurred_px must be at least 1");
    if (!(job.sprites.bright_factor > 0)) return invalid("sprites.bright_factor must be more than 0");
    if (job.pupil_points < 1) return invalid("job.pupil_points must be at least 1");
    return Done{};
}

PreparedFrame::PreparedFrame(const DefocusJob& job, const Radii& radii, double lens_reach_px) {
    engine::Samples& samples = view.samples;
    samples.colour = job.colour;
    if (!is_finite(job.colour, *job.workers))
        samples.colour = repaired_ = finite_picture(job.colour, *job.workers);
    shows_spent = job.spent_colour && job.mask.empty() && job.layers.empty() && !job.colour.empty() &&
                  job.scatter.view == ScatterView::Result &&
                  job.spent_colour->pixels() == samples.colour.row(0);
    if (job.scatter.view == ScatterView::Guessed) samples.layers.push_back({samples.colour, false, true});
    for (const ColourLayer& layer : job.layers) {
        samples.layers.push_back({layer.colour, layer.is_light});
        if (is_finite(layer.colour, *job.workers)) continue;
        repaired_layers_.push_back(finite_picture(layer.colour, *job.workers));
        samples.layers.back().colour = repaired_layers_.back();
    }
    samples.coc_px = spare.coc_px = radii.of(depth_or_radii(job), *job.workers);
    take_samples(job, radii, lens_reach_px);
    note_radii();
    points_ = drawable_points(
        job, [&](float depth_m) { return radii(depth_m); }, warnings);
    samples.points = points_;
    if (!has_radii(job)) samples.depth_m = job.depth_m;
    view.window.open_edges = open_edges(job);
    place_in_field(job);
    view.lens.radius_at_infinity_px = radii.at_infinity_px();
    take_options(job);
    view.services.workers = job.workers;
    view.services.max_memory_bytes = job.max_memory_bytes;
}

void PreparedFrame::take_options(const DefocusJob& job) {
    engine::EngineOptions& options = view.options;
    options.quality = job.quality, options.fill = job.fill;
    if (job.engine == "gather" || job.engine == "realtime")
        options.own = engine::GatherOwn{job.gather, job.sprites};
    else if (job.engine == "gaussian")
        options.own = engine::GaussianOwn{job.gaussian};
    else if (job.engine == "sprites")
        options.own = engine::SpritesOwn{job.sprites, job.gather, job.gaussian};
    else if (job.engine == "reference")
        options.own = engine::ReferenceOwn{job.pupil_points, job.seed};
}

void PreparedFrame::take_samples(const DefocusJob& job, const Radii& radii, double lens_reach_px) {
    engine::Samples& seen = view.samples;
    const engine::StatedPicture stated{seen.colour, depth_or_radii(job), has_radii(job),
                                       job.deep,    job.behind,          radii};
    samples_ = engine::all_samples(stated, *job.workers);
    plate_ = engine::back_picture(stated, *job.workers);
    const bool all = job.scatter.view == ScatterView::Layers || job.scatter.view == ScatterView::Hidden;
    if (!plate_.empty()) seen.plate = {plate_.colour, plate_.coc_px, all};
    if (!all) engine::drop_out_of_sight(samples_, lens_reach_px, *job.workers);
    if (!samples_.first.empty()) seen.deep = samples_;
    seen.deep_dims_itself = job.deep && !job.deep->empty();
    if (job.fill != Fill::Full && !seen.deep.empty() && (seen.plate.empty() || job.engine != "scatter"))
        warnings.emplace_back("job.fill has no effect where all samples of a pixel are given");
    if (job.holdout && !job.holdout->empty())
        seen.holdout = holdout_ = engine::deep_samples(*job.holdout, radii, has_radii(job), *job.workers);
}

void PreparedFrame::note_radii() {
    engine::Samples& seen = view.samples;
    const auto note = [&](float radius_px) {
        seen.nearest_coc_px = std::min(seen.nearest_coc_px, radius_px);
        seen.farthest_coc_px = std::max(seen.farthest_coc_px, radius_px);
    };
    for (std::size_t i = 0; i < spare.coc_px.size(); ++i) note(spare.coc_px.pixels()[i]);
    for (const engine::CocSample& sample : samples_.samples) note(sample.coc_px);
}

void PreparedFrame::place_in_field(const DefocusJob& job) {
    engine::LensOnPicture& lens = view.lens;
    static_cast<PixelField&>(lens) = job.place.field();
    const Rect& data = job.place.data_window;
    lens.frame = job.place.display_window.moved(-data.x0, -data.y0);
    if (has_radii(job)) return;
    lens.focus_distance_m = job.camera.focus_distance_m;
    lens.tan_per_field = job.camera.sensor_width_mm / job.camera.focal_length_mm /
                         (job.place.display_window.width() * lens.field_per_px);
}

}  // namespace petzval
