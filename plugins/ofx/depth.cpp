#include "depth.h"

#include "petzval/depth.h"
#include "petzval/files.h"
#include "petzval/frames.h"
#include "petzval/place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace petzval::plugin {
namespace {

constexpr float kMiss = std::numeric_limits<float>::infinity();

Error refused(std::string why) { return {ErrorCode::InvalidArgument, std::move(why)}; }

// One value for each pixel of `source`, top row first.
template <typename At>
Plane plane_like(const LentImage& source, const At& at) {
    Plane plane = Plane::uninitialised(source.width(), source.height());
    const int left = source.bounds().x1, top = source.bounds().y2 - 1;
    for (int y = 0; y < plane.height(); ++y)
        for (int x = 0; x < plane.width(); ++x) plane(x, y) = at(left + x, top - y);
    return plane;
}

Place place_of(const DepthQuestion& q) {
    return {q.frame->rect(q.frame->display), q.frame->rect(q.source->bounds()), q.frame->pixel_aspect};
}

DepthSettings settings_of(const Values& v) {
    DepthSettings settings;
    settings.kind = v.depth_kind;
    settings.unit_scale_m = v.depth_unit_m;
    settings.focal_length_mm = v.focal_length_mm;
    settings.sensor_width_mm = v.sensor_width_mm;
    const bool radii = v.depth_kind == DepthKind::CocPx;
    const bool may_begin_at_0 = radii || v.depth_kind == DepthKind::Normalized || is_mist(v.depth_kind);
    if (v.depth_near != 0 || (may_begin_at_0 && v.depth_far != 0)) settings.range_near = v.depth_near;
    if (v.depth_far != 0 || (radii && v.depth_near != 0)) settings.range_far = v.depth_far;
    return settings;
}

// Hosts that have only RGBA may put depth into alpha: then colour is 0 everywhere, and alpha is not coverage.
bool is_in_alpha(const LentImage& depth) {
    if (depth.channels() != 4) return false;
    bool other_than_coverage = false;
    for (int y = depth.bounds().y1; y < depth.bounds().y2; ++y)
        for (int x = depth.bounds().x1; x < depth.bounds().x2; ++x) {
            for (int channel = 0; channel < 3; ++channel)
                if (depth.value(x, y, channel, 0) != 0) return false;
            const float a = depth.value(x, y, 3, 0);
            other_than_coverage = other_than_coverage || (a != 0 && a != 1);
        }
    return other_than_coverage;
}

// Values as rendered.
struct Stored {
    Plane depth;
    bool is_share = false;   // of whole numbers
    std::string doubt = {};  // as in DepthOfFrame
};

std::string size_text(const ofx::RectI& r) {
    return std::to_string(r.x2 - r.x1) + " x " + std::to_string(r.y2 - r.y1);
}

// True for the same frame at another scale. Hosts crop and place pictures, but scale them only if told to.
bool is_scaled(const ofx::RectI& a, const ofx::RectI& b) {
    const double width = a.x2 - a.x1, height = a.y2 - a.y1;
    const double x = width / (b.x2 - b.x1), y = height / (b.y2 - b.y1);
    return a.x1 == b.x1 && a.y1 == b.y1 && (x > 1.1 || x < 0.9) && std::abs(x - y) < 0.01 * y;
}

Result<Stored> of_clip(const DepthQuestion& q, const char* clip) {
    const LentImage depth(q.effect, clip, q.time);
    if (!depth.is_there()) return refused(std::string("the clip ") + clip + " has no image at this frame");
    if (!depth.is_readable()) return refused(std::string("the clip ") + clip + " must have float pixels");
    if (is_scaled(depth.region(), q.source->region()))
        return refused(std::string("the clip ") + clip + " is " + size_text(depth.region()) +
                       " pixels, and Source is " + size_text(q.source->region()) + "; scale it to that size");
    const int channel = is_in_alpha(depth) ? 3 : 0;
    return Stored{plane_like(*q.source, [&](int x, int y) { return depth.value(x, y, channel, kMiss); })};
}

// Errors: those of read_depth_file() and check_depth_codes(). A unit of its own shows that a user chose
// planar depth, which is the menu's default.
Result<Stored> of_file(const DepthQuestion& q) {
    const Values& v = *q.values;
    if (v.depth_file.empty()) return refused("Depth from is 'file', but Depth file is empty");
    const double frame_number = std::clamp(std::floor(q.time + v.depth_frame_offset), -1e9, 2e9);
    ReadOptions options;
    options.depth_file = at_frame(v.depth_file, int(frame_number));
    options.depth_channel = v.depth_channel;
    auto file = read_depth_file(options, place_of(q));
    if (!file) return file.error();
    if (file->is_share)
        if (const Status fine = check_depth_codes(settings_of(v), v.depth_unit_m != 1); !fine)
            return refused(options.depth_file + ": " + fine.error().message);
    std::string doubt = file->is_colour ? file->detected.front() : "";
    if (doubt.empty() && !file->warnings.empty()) doubt = file->warnings.front();
    return Stored{std::move(file->depth), file->is_share, std::move(doubt)};
}

Result<Stored> stored_depth(const DepthQuestion& q) {
    switch (q.values->depth_from) {
        case DepthFrom::Clip:
            return of_clip(q, kDepthClip);
        case DepthFrom::File:
            return of_file(q);
        case DepthFrom::Alpha:
            return Stored{
                plane_like(*q.source, [&](int x, int y) { return q.source->value(x, y, 3, kMiss); })};
        case DepthFrom::Auto:
            break;
    }
    if (is_connected(q.effect, kDepthClip)) return of_clip(q, kDepthClip);
    if (!q.values->depth_file.empty()) return of_file(q);
    return refused("no depth: connect the clip Depth, give a Depth file, or take alpha as depth");
}

Result<DepthOfFrame> in_metres_or_radii(const DepthQuestion& q, Stored stored) {
    const DepthSettings settings = settings_of(*q.values);
    Plane& depth = stored.depth;
    join_depth_codes(depth, settings, stored.is_share);
    const bool radii = settings.kind == DepthKind::CocPx;
    const auto done = radii ? depth_to_radii_px(depth.view(), settings)
                            : depth_to_planar_metres(depth.view(), place_of(q), settings);
    if (!done) return done.error();
    if (radii)  // of the frame at full size
        for (std::size_t i = 0; i < depth.size(); ++i)
            depth.pixels()[i] = float(depth.pixels()[i] * q.scale.x);
    return DepthOfFrame{std::move(depth), radii, std::move(stored.doubt)};
}

}  // namespace

Result<DepthOfFrame> depth_of(const DepthQuestion& question) {
    auto stored = stored_depth(question);
    if (!stored) return stored.error();
    return in_metres_or_radii(question, std::move(*stored));
}

Result<DepthOfFrame> plate_depth_of(const DepthQuestion& question) {
    auto stored = of_clip(question, kPlateDepthClip);
    if (!stored) return stored.error();
    return in_metres_or_radii(question, std::move(*stored));
}

Plane mask_of(const DepthQuestion& q) {
    if (!is_connected(q.effect, kMaskClip)) return {};
    const LentImage mask(q.effect, kMaskClip, q.time);
    if (!mask.is_readable()) return {};
    return plane_like(*q.source, [&](int x, int y) {
        return std::clamp(mask.value(x, y, mask.channels() - 1, 0), 0.0f, 1.0f);
    });
}

}  // namespace petzval::plugin
