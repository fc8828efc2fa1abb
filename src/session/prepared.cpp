#include "session/prepared.h"

#include "base/parallel.h"
#include "engine/samples/all_samples.h"
#include "engine/samples/behind/out_of_sight.h"
#include "engine/samples/deep/deep_samples.h"
#include "session/rendered/light_points.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>

namespace petzval {
namespace {

// Radii beyond any picture are as good as this; keeps all arithmetic finite.
constexpr float kLargestRadiusPx = 16384;

float finite_radius(double radius_px) {
    if (std::isnan(radius_px)) return 0;
    return float(std::clamp(radius_px, double(-kLargestRadiusPx), double(kLargestRadiusPx)));
}

bool is_finite(View<const Rgba> colour, Workers& workers) {
    std::atomic<bool> finite{true};
    parallel_for(colour.height(), workers, [&](int y) {
        const Rgba* const row = colour.row(y);
        int repaired = 0;
        for (int x = 0; x < colour.width(); ++x) repaired += !(engine::finite_colour(row[x]) == row[x]);
        if (repaired > 0) finite = false;
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
engine::OpenEdges open_edges(const FrameRequest& request) {
    const Rect& display = request.rendered.place.display_window;
    const Rect& data = request.rendered.place.data_window;
    return {data.x0 <= display.x0, data.y0 <= display.y0, data.x1 >= display.x1, data.y1 >= display.y1};
}

}  // namespace

Result<Radii> Radii::make(const FrameRequest& request) {
    Radii radii;
    if (has_radii(request.rendered)) return radii;
    const auto coc = CircleOfConfusion::make(request.rendered.camera,
                                             request.rendered.place.display_window.width(), request.look.coc);
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
        for (float* depth : {&s.depth, &s.depth_back})
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

namespace {

// Sizes and windows.
Status check_pictures(const Rendered& rendered) {
    if (rendered.colour.empty()) return invalid("the picture is empty");
    const View<const float> depth = depth_or_radii(rendered);
    if (depth.width() != rendered.colour.width() || depth.height() != rendered.colour.height()) {
        std::ostringstream text;
        text << "depth is " << depth.width() << "x" << depth.height() << " and colour "
             << rendered.colour.width() << "x" << rendered.colour.height()
             << "; they must have the same size";
        return invalid(text.str());
    }
    for (const DeepPicture* deep : {rendered.deep, rendered.behind, rendered.holdout})
        if (deep && !deep->empty() &&
            (deep->width() != rendered.colour.width() || deep->height() != rendered.colour.height()))
            return invalid("the deep samples, hidden layers and holdout must have the picture's size");
    for (const ColourLayer& layer : rendered.layers)
        if (layer.colour.width() != rendered.colour.width() ||
            layer.colour.height() != rendered.colour.height())
            return invalid("the layers must have the picture's size");
    if (!rendered.mask.empty() && (rendered.mask.width() != rendered.colour.width() ||
                                   rendered.mask.height() != rendered.colour.height()))
        return invalid("shot.mask must have the picture's size");
    if (const Status fine = check(rendered.place); !fine) return fine;
    if (!rendered.place.fits(rendered.colour.width(), rendered.colour.height()))
        return invalid("place.data_window must have the picture's size");
    return Done{};
}

}  // namespace

Status check_request(const FrameRequest& request) {
    const Rendered& rendered = request.rendered;
    const Look& look = request.look;
    if (const Status fit = check_pictures(rendered); !fit) return fit;
    if (!rendered.layers.empty() && request.view != ScatterView::Result)
        return invalid("shot.layers are blurred in results, not in views");
    if (rendered.lights && !rendered.lights->empty() && look.engine != "sprites")
        return invalid("shot.lights are drawn by job.engine sprites, not " + look.engine);
    if (request.view != ScatterView::Result && look.engine != "scatter")
        return invalid(
            "layers, levels of detail, highlights and hidden surfaces exist only in job.engine "
            "scatter, not " +
            look.engine);
    if (request.view == ScatterView::Hidden && !(look.coc == CocControls{}))
        return invalid(
            "the view of hidden surfaces needs the depth behind each radius, so it cannot be combined with "
            "focus.range_m, focus.near_scale, focus.far_scale or focus.max_radius_px");
    if (look.gaussian.along_ray && has_radii(rendered))
        return invalid("gaussian.depth_along ray counts metres; radii were given");
    if (!(look.gather.pixel_size_px >= 0 && look.gather.pixel_size_px < 1))
        return invalid("gather.pixel_size_px must be 0 or more, and less than 1");
    if (!(look.gather.tap_offset > 0 && look.gather.tap_offset <= 4))
        return invalid("gather.tap_offset must be more than 0, and at most 4");
    if (const double from = look.gather.blurred_px.value_or(1); !(from >= 1 && std::isfinite(from)))
        return invalid("gather.blurred_px must be at least 1");
    if (!(look.sprites.bright_factor > 0)) return invalid("sprites.bright_factor must be more than 0");
    if (look.pupil_points < 1) return invalid("job.pupil_points must be at least 1");
    return Done{};
}

PreparedFrame::PreparedFrame(const FrameRequest& request, const Radii& radii, double lens_reach_px) {
    engine::Samples& samples = view.samples;
    samples.colour = request.rendered.colour;
    if (!is_finite(request.rendered.colour, *request.workers))
        samples.colour = repaired_ = finite_picture(request.rendered.colour, *request.workers);
    if (is_matte(request)) samples.layers.push_back({samples.colour, false, true});
    for (const ColourLayer& layer : request.rendered.layers) {
        samples.layers.push_back({layer.colour, layer.is_light});
        if (is_finite(layer.colour, *request.workers)) continue;
        repaired_layers_.push_back(finite_picture(layer.colour, *request.workers));
        samples.layers.back().colour = repaired_layers_.back();
    }
    const View<const float> depth = depth_or_radii(request.rendered);
    samples.coc_px = spare.coc_px = radii.of(depth, *request.workers);
    take_samples(request, depth, radii, lens_reach_px);
    note_radii();
    points_ = drawable_points(
        request.rendered, [&](float depth_m) { return radii(depth_m); }, warnings);
    samples.points = points_;
    if (!has_radii(request.rendered)) samples.depth_m = depth;
    view.window.open_edges = open_edges(request);
    place_in_field(request);
    view.lens.radius_at_infinity_px = radii.at_infinity_px();
    take_options(request);
    view.services.workers = request.workers;
    view.services.max_memory_bytes = request.max_memory_bytes;
}

void PreparedFrame::take_options(const FrameRequest& request) {
    engine::EngineOptions& options = view.options;
    options.quality = request.look.quality;
    options.fill = request.look.fill;
    if (request.look.engine == "gather" || request.look.engine == "realtime")
        options.own = engine::GatherOwn{request.look.gather, request.look.sprites};
    else if (request.look.engine == "gaussian")
        options.own = engine::GaussianOwn{request.look.gaussian};
    else if (request.look.engine == "sprites")
        options.own = engine::SpritesOwn{request.look.sprites, request.look.gather, request.look.gaussian};
    else if (request.look.engine == "reference")
        options.own = engine::ReferenceOwn{request.look.pupil_points, request.look.seed};
}

void PreparedFrame::take_samples(const FrameRequest& request, View<const float> depth, const Radii& radii,
                                 double lens_reach_px) {
    engine::Samples& seen = view.samples;
    const engine::StatedDepth meaning = has_radii(request.rendered)
                                            ? engine::StatedDepth(engine::StatedRadii{radii})
                                            : engine::StatedDepth(engine::StatedMetres{radii});
    const engine::StatedPicture stated{seen.colour, depth, request.rendered.deep, request.rendered.behind,
                                       meaning};
    samples_ = engine::all_samples(stated, *request.workers);
    plate_ = engine::back_picture(stated, *request.workers);
    const bool all = request.view == ScatterView::Layers || request.view == ScatterView::Hidden;
    if (!all) {
        engine::drop_out_of_sight(samples_, lens_reach_px, open_edges(request), *request.workers);
        if (!plate_.empty()) plate_.mark_out_of_sight(samples_);
    }
    if (!plate_.empty()) seen.plate = plate_.view();
    if (!samples_.first.empty()) seen.deep = samples_;
    seen.deep_dims_itself = request.rendered.deep && !request.rendered.deep->empty();
    if (request.rendered.holdout && !request.rendered.holdout->empty())
        seen.holdout = holdout_ = engine::deep_samples(*request.rendered.holdout, meaning, *request.workers);
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

void PreparedFrame::place_in_field(const FrameRequest& request) {
    engine::LensOnPicture& lens = view.lens;
    static_cast<PixelField&>(lens) = request.rendered.place.field();
    const Rect& data = request.rendered.place.data_window;
    lens.frame = request.rendered.place.display_window.moved(-data.x0, -data.y0);
    if (has_radii(request.rendered)) return;
    lens.focus_distance_m = request.rendered.camera.focus_distance_m;
    lens.tan_per_field = request.rendered.camera.sensor_width_mm / request.rendered.camera.focal_length_mm /
                         (request.rendered.place.display_window.width() * lens.field_per_px);
}

}  // namespace petzval
