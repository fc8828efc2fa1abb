#include "render.h"

#include "petzval/petzval_c.h"
#include "petzval/result.h"

#include "depth.h"
#include "images.h"
#include "look.h"
#include "params.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace petzval::plugin {
namespace {

petzval_session* the_session = nullptr;

Error refused(std::string why) { return {ErrorCode::InvalidArgument, std::move(why)}; }

// One render action.
struct Job {
    ofx::Effect* effect;
    ofx::Time time;
    ofx::Point scale;
    ofx::RectI window{};
    bool draft = false, no_blur = false;
    const LentImage *source = nullptr, *output = nullptr;
};

Job job_of(ofx::Effect* effect, const Properties& in) {
    Job job{effect, in.number(ofx::kTime), in.point(ofx::kRenderScale, {1, 1})};
    if (!(job.scale.x > 0) || !(job.scale.y > 0)) job.scale = {1, 1};
    in.rect(ofx::kRenderWindow, job.window);
    job.draft = in.integer(ofx::kDraft) != 0 || in.integer(ofx::kInteractive) != 0;
    job.no_blur = in.text(ofx::kNoSpatial) == "true";
    return job;
}

// Emptiness in the window where Source has no pixels.
void clear_beyond(const Job& job, const ofx::RectI& covered) {
    for (int y = job.window.y1; y < job.window.y2; ++y)
        for (int x = job.window.x1; x < job.window.x2; ++x) {
            const bool inside = x >= covered.x1 && x < covered.x2 && y >= covered.y1 && y < covered.y2;
            if (!inside) std::memset(job.output->pixel(x, y), 0, 4 * sizeof(float));
        }
}

void copy_source(const Job& job, const ofx::RectI& covered) {
    const Coding from = job.source->coding(Transfer::Linear), to = job.output->coding(Transfer::Linear);
    const bool same = from.is_unpremultiplied == to.is_unpremultiplied;
    for (int y = covered.y1; y < covered.y2; ++y)
        for (int x = covered.x1; x < covered.x2; ++x) {
            float rgba[4];
            std::memcpy(rgba, job.source->pixel(x, y), sizeof rgba);
            if (!same) from.to_light(rgba), to.from_light(rgba);
            std::memcpy(job.output->pixel(x, y), rgba, sizeof rgba);
        }
}

// Memory for the pixels of `part`: the host's own where that takes premultiplied light.
class Target {
public:
    Target(const LentImage& output, const ofx::RectI& part, const Coding& coding)
        : output_(output), part_(part), coding_(coding), pixels_(pixels_of(output, part)) {
        if (output.is_aligned() && coding.is_premultiplied_light()) return;
        made_.resize(std::size_t(width()) * std::size_t(height()) * 4);
        pixels_ = pixels_of(made_, width(), height());
    }
    petzval_pixels* pixels() { return &pixels_; }
    void finish() {
        const std::size_t row = std::size_t(width()) * 4;
        for (std::size_t i = 0; i < made_.size() && !coding_.is_premultiplied_light(); i += 4)
            coding_.from_light(made_.data() + i);
        for (int y = 0; y < height() && !made_.empty(); ++y)
            std::memcpy(output_.pixel(part_.x1, part_.y2 - 1 - y), made_.data() + std::size_t(y) * row,
                        row * sizeof(float));
    }

private:
    int width() const { return part_.x2 - part_.x1; }
    int height() const { return part_.y2 - part_.y1; }

    const LentImage& output_;
    ofx::RectI part_;
    Coding coding_;
    std::vector<float> made_;
    petzval_pixels pixels_;
};

int keep_on(void* effect, double) { return suites().effect->abort(static_cast<ofx::Effect*>(effect)) == 0; }

petzval_rect lent(const Rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

// Memory of one frame.
struct Scene {
    std::vector<float> rgba, plate_rgba;
    Plane mask_values;
    DepthOfFrame depth;
    std::vector<std::uint64_t> first;
    std::vector<petzval_deep_sample> samples;
    petzval_pixels colour{};
    petzval_plane depth_plane{}, mask{};
    petzval_camera camera{};
    petzval_deep plate{};
    petzval_shot shot{};
};

petzval_plane plane_of(Plane& values) {
    petzval_plane plane{};
    plane.size = sizeof plane;
    plane.width = values.width();
    plane.height = values.height();
    plane.data = values.pixels();
    plane.pixel_stride = sizeof(float);
    plane.row_stride = plane.pixel_stride * values.width();
    return plane;
}

// The clean plate as one sample for each pixel that shows something.
Status take_plate(const DepthQuestion& q, Scene& scene) {
    if (!is_connected(q.effect, kPlateClip)) return Done{};
    const LentImage plate(q.effect, kPlateClip, q.time);
    if (!plate.is_readable() || plate.channels() != 4)
        return refused("the clip Plate must have RGBA float pixels");
    if (!is_connected(q.effect, kPlateDepthClip))
        return refused("the clip Plate needs its depth: connect the clip PlateDepth");
    const auto depth = plate_depth_of(q);
    if (!depth) return depth.error();
    const Coding coding = plate.coding(q.values->transfer);
    scene.first.push_back(0);
    std::size_t pixel = 0;
    const ofx::RectI& bounds = q.source->bounds();
    for (int y = bounds.y2 - 1; y >= bounds.y1; --y)
        for (int x = bounds.x1; x < bounds.x2; ++x) {
            float c[4];
            for (int i = 0; i < 4; ++i) c[i] = plate.value(x, y, i, 0);
            coding.to_light(c);
            const float at = depth->values.pixels()[pixel++];
            if (c[0] != 0 || c[1] != 0 || c[2] != 0 || c[3] != 0)
                scene.samples.push_back({c[0], c[1], c[2], c[3], at, at});
            scene.first.push_back(scene.samples.size());
        }
    scene.plate.size = sizeof scene.plate;
    scene.plate.width = q.source->width();
    scene.plate.height = q.source->height();
    scene.plate.first = scene.first.data();
    scene.plate.samples = scene.samples.data();
    scene.plate.sample_count = scene.samples.size();
    scene.shot.behind = &scene.plate;
    return Done{};
}

// Errors: InvalidArgument for a point outside of Source, or one that shows nothing.
Result<double> depth_at_point(const DepthQuestion& q, const DepthOfFrame& depth) {
    const ofx::Point p = q.values->focus_point;
    const ofx::RectI& frame = q.frame->display;
    const bool middle = q.values->focus_is_middle;
    const int x =
        middle ? (frame.x1 + frame.x2) / 2 : int(std::floor(p.x * q.scale.x / q.source->pixel_aspect()));
    const int y = middle ? (frame.y1 + frame.y2) / 2 : int(std::floor(p.y * q.scale.y));
    const ofx::RectI& bounds = q.source->bounds();
    if (depth.are_radii) return refused("Focus on 'point' needs depth, not radii");
    if (x < bounds.x1 || x >= bounds.x2 || y < bounds.y1 || y >= bounds.y2)
        return refused("the focus point is outside Source");
    const double metres = depth.values(x - bounds.x1, bounds.y2 - 1 - y);
    if (!std::isfinite(metres)) return refused("the picture has no depth at the focus point");
    return metres;
}

Status take_camera(const DepthQuestion& q, Scene& scene) {
    const Values& v = *q.values;
    scene.camera.size = sizeof scene.camera;
    scene.camera.focal_length_mm = v.focal_length_mm;
    scene.camera.sensor_width_mm = v.sensor_width_mm;
    scene.camera.f_number = v.f_number;
    scene.camera.focus_distance_m = v.focus_distance_m;
    scene.shot.camera = &scene.camera;
    if (v.focus_from == FocusFrom::Distance) return Done{};
    const auto metres = depth_at_point(q, scene.depth);
    if (!metres) return metres.error();
    scene.camera.focus_distance_m = *metres;
    return Done{};
}

void take_colour(const Job& job, const Values& values, Scene& scene) {
    const LentImage& source = *job.source;
    const Coding coding = source.coding(values.transfer);
    const bool opaque = values.depth_from == DepthFrom::Alpha;
    if (source.is_aligned() && coding.is_premultiplied_light()) {
        scene.colour = pixels_of(source, source.bounds());
    } else {
        scene.rgba = light_of(source, coding, opaque);
        scene.colour = pixels_of(scene.rgba, source.width(), source.height());
    }
    if (opaque) scene.colour.a = nullptr;
    scene.shot.colour = &scene.colour;
}

Status take_scene(const Job& job, const Values& values, const FrameOfHost& frame, Scene& scene) {
    const DepthQuestion question{job.effect, job.time, &values, job.source, &frame, job.scale};
    auto depth = depth_of(question);
    if (!depth) return depth.error();
    petzval_shot& shot = scene.shot;
    shot.size = sizeof shot;
    scene.depth = std::move(*depth);
    scene.depth_plane = plane_of(scene.depth.values);
    (scene.depth.are_radii ? shot.radii_px : shot.depth_m) = &scene.depth_plane;
    scene.mask_values = mask_of(question);
    if (!scene.mask_values.empty()) {
        scene.mask = plane_of(scene.mask_values);
        shot.mask = &scene.mask;
    }
    shot.display_window = lent(frame.rect(frame.display));
    shot.data_window = lent(frame.rect(job.source->bounds()));
    shot.pixel_aspect = frame.pixel_aspect;
    take_colour(job, values, scene);
    if (Status taken = take_camera(question, scene); !taken) return taken;
    return take_plate(question, scene);
}

int status_of(petzval_status status) {
    if (status == PETZVAL_OK || status == PETZVAL_CANCELLED) return ofx::kOk;
    return status == PETZVAL_OUT_OF_MEMORY ? ofx::kMemory : ofx::kFailed;
}

// The blurred pixels of `part`, written into the output. doubt: DepthOfFrame::doubt.
int make_part(const Job& job, const ofx::RectI& part, std::string& doubt) {
    const auto failed = [&](const std::string& why, int status) {
        show_error(job.effect, in_labels(why));
        return status;
    };
    const Values values = values_at(job.effect, job.time);
    const FrameOfHost frame =
        frame_of(job.effect, *job.source, job.scale, values.sensor_spans == SensorSpans::Source);
    Scene scene;
    if (const Status taken = take_scene(job, values, frame, scene); !taken)
        return failed(taken.error().message, ofx::kFailed);
    doubt = scene.depth.doubt;
    const auto look = look_of(values, job.draft && values.draft_when_interactive);
    if (!look) return failed(look.error().message, ofx::kFailed);
    petzval_control control{};
    control.size = sizeof control;
    control.host = job.effect;
    control.progress = keep_on;
    control.region = lent(frame.rect(part));
    Target target(*job.output, part, job.output->coding(values.transfer));
    const petzval_status status =
        petzval_defocus(the_session, &scene.shot, look->get(), &control, target.pixels(), nullptr);
    if (status_of(status) != ofx::kOk) return failed(petzval_error_text(), status_of(status));
    target.finish();
    return ofx::kOk;
}

bool holds(const ofx::RectI& outer, const ofx::RectI& inner) {
    return inner.x1 >= outer.x1 && inner.x2 <= outer.x2 && inner.y1 >= outer.y1 && inner.y2 <= outer.y2;
}

// Largest radius that any depth can have, in pixels of the frame at full size, if it is behind half of the
// focal length: 1/2 D |z - F| / (z F) f W / s (docs/conventions.md) is largest at the ends of the range of z.
double largest_radius_px(const Values& v, double width_px) {
    const double f = v.focal_length_mm / 1000, aperture = f / v.f_number, focus = v.focus_distance_m;
    const double scale = 0.5 * aperture * f * width_px / (v.sensor_width_mm / 1000);
    const double near = std::min(f, focus);
    return scale * std::max(1 / focus, (focus - near) / (near * focus));
}

}  // namespace

void open_session() { petzval_session_open(nullptr, &the_session); }

void close_session() {
    petzval_session_close(the_session);
    the_session = nullptr;
}

int render(ofx::Effect* effect, const Properties& in) {
    Job job = job_of(effect, in);
    const auto failed = [&](const char* why, int status) {
        show_error(effect, why);
        return status;
    };
    const LentImage output(effect, ofx::kOutput, job.time), source(effect, ofx::kSource, job.time);
    if (!output.is_there()) return ofx::kFailed;
    if (!output.is_readable() || output.channels() != 4)
        return failed("Output must have RGBA float pixels", ofx::kImageFormat);
    if (is_empty(job.window)) return ofx::kOk;
    if (!holds(output.bounds(), job.window))
        return failed("Output does not contain the render window", ofx::kFailed);
    if (source.is_there() && (!source.is_readable() || source.channels() != 4))
        return failed("Source must have RGBA float pixels", ofx::kImageFormat);
    job.source = &source;
    job.output = &output;
    const ofx::RectI part = source.is_there() ? intersected(job.window, source.bounds()) : ofx::RectI{};
    int status = ofx::kOk;
    std::string doubt;
    if (!is_empty(part) && job.no_blur) copy_source(job, part);
    if (!is_empty(part) && !job.no_blur) status = make_part(job, part, doubt);
    if (status != ofx::kOk) return status;
    clear_beyond(job, part);
    clear_message(effect);
    if (!doubt.empty()) show_warning(effect, doubt);
    return ofx::kOk;
}

// A lens that cannot blur by a hundredth of a pixel, with the look's own fields at their defaults.
int is_identity(ofx::Effect* effect, const Properties& in, Properties out) {
    const Job job = job_of(effect, in);
    const Values values = values_at(effect, job.time);
    const double width = properties_of(effect).number(ofx::kProjectSize) * job.scale.x;
    const bool pinhole = values.look.empty() && values.preset.empty() && values.lens.empty() && width > 0 &&
                         values.depth_kind != DepthKind::CocPx && largest_radius_px(values, width) < 0.01;
    if (!pinhole && !job.no_blur) return ofx::kReplyDefault;
    out.set(ofx::kName, ofx::kSource).set(ofx::kTime, job.time);
    return ofx::kOk;
}

namespace {

bool clip_region(ofx::Effect* effect, const char* name, ofx::Time time, ofx::Rect& region) {
    ofx::Clip* clip = nullptr;
    if (suites().effect->clip_handle(effect, name, &clip, nullptr) != ofx::kOk || !clip) return false;
    return suites().effect->clip_region(clip, time, &region) == ofx::kOk && region.x2 > region.x1 &&
           region.y2 > region.y1;
}

}  // namespace

// Any pixel's light may reach any other: near things have no largest radius. So all of every clip is needed.
int regions_of_interest(ofx::Effect* effect, const Properties& in, Properties out) {
    for (const char* clip : {ofx::kSource, kDepthClip, kPlateClip, kPlateDepthClip, kMaskClip}) {
        ofx::Rect all{};
        if (clip != ofx::kSource && !is_connected(effect, clip)) continue;
        if (clip_region(effect, clip, in.number(ofx::kTime), all))
            out.set((std::string(ofx::kInterestOf) + clip).c_str(), all);
    }
    return ofx::kOk;
}

int region_of_definition(ofx::Effect* effect, const Properties& in, Properties out) {
    ofx::Rect source{};
    if (!clip_region(effect, ofx::kSource, in.number(ofx::kTime), source)) return ofx::kReplyDefault;
    out.set(ofx::kDefinition, source);
    return ofx::kOk;
}

}  // namespace petzval::plugin
