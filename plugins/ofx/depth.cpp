#include "depth.h"

#include "petzval/depth.h"
#include "petzval/files.h"
#include "petzval/frames.h"

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
std::vector<float> plane_like(const LentImage& source, const At& at) {
    std::vector<float> values;
    values.reserve(std::size_t(source.width()) * std::size_t(source.height()));
    for (int y = source.bounds().y2 - 1; y >= source.bounds().y1; --y)
        for (int x = source.bounds().x1; x < source.bounds().x2; ++x) values.push_back(at(x, y));
    return values;
}

DepthSettings settings_of(const Values& v) {
    DepthSettings settings;
    settings.kind = v.depth_kind;
    settings.unit_scale_m = v.depth_unit_m;
    settings.focal_length_mm = v.focal_length_mm;
    settings.sensor_width_mm = v.sensor_width_mm;
    const bool may_begin_at_0 = v.depth_kind == DepthKind::Normalized || is_mist(v.depth_kind);
    if (v.depth_near > 0 || (may_begin_at_0 && v.depth_far > 0)) settings.range_near = v.depth_near;
    if (v.depth_far > 0) settings.range_far = v.depth_far;
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

Result<std::vector<float>> of_clip(const DepthQuestion& q, const char* clip) {
    const LentImage depth(q.effect, clip, q.time);
    if (!depth.is_there()) return refused(std::string("the clip ") + clip + " has no image at this frame");
    if (!depth.is_readable()) return refused(std::string("the clip ") + clip + " is not of float pixels");
    const int channel = is_in_alpha(depth) ? 3 : 0;
    Plane plane(q.source->width(), q.source->height());
    std::vector<float> values =
        plane_like(*q.source, [&](int x, int y) { return depth.value(x, y, channel, kMiss); });
    std::copy(values.begin(), values.end(), &plane(0, 0));
    if (join_depth_codes(plane, settings_of(*q.values), false) > 0)
        std::copy_n(&plane(0, 0), values.size(), values.begin());
    return values;
}

Result<std::vector<float>> of_file(const DepthQuestion& q) {
    const Values& v = *q.values;
    if (v.depth_file.empty()) return refused("Depth from is 'file', but Depth file is empty");
    ReadOptions options;
    options.need_colour = false;
    options.depth_channel = v.depth_channel;
    const double frame_number = std::clamp(std::floor(q.time + v.depth_frame_offset), -1e9, 2e9);
    const std::string path = at_frame(v.depth_file, int(frame_number));
    auto file = read_frame(path, options);
    if (!file) return file.error();
    if (file->deep.empty()) join_depth_codes(file->depth, settings_of(v), file->depth_is_share);
    // The file covers the frame at full size; each pixel of the host takes the pixel under its centre.
    const petzval::Rect &whole = file->place.display_window, &data = file->place.data_window;
    const ofx::RectI& frame = q.frame->display;
    const double across = double(whole.width()) / (frame.x2 - frame.x1);
    const double down = double(whole.height()) / (frame.y2 - frame.y1);
    return plane_like(*q.source, [&](int x, int y) {
        const int column = whole.x0 + int(std::floor((x + 0.5 - frame.x1) * across)) - data.x0;
        const int row = whole.y0 + int(std::floor((frame.y2 - y - 0.5) * down)) - data.y0;
        return file->depth.view().rect().contains(column, row) ? file->depth(column, row) : kMiss;
    });
}

Result<std::vector<float>> stored_depth(const DepthQuestion& q) {
    switch (q.values->depth_from) {
        case DepthFrom::Clip:
            return of_clip(q, kDepthClip);
        case DepthFrom::File:
            return of_file(q);
        case DepthFrom::Alpha:
            return plane_like(*q.source, [&](int x, int y) { return q.source->value(x, y, 3, kMiss); });
        case DepthFrom::Auto:
            break;
    }
    if (is_connected(q.effect, kDepthClip)) return of_clip(q, kDepthClip);
    if (!q.values->depth_file.empty()) return of_file(q);
    return refused("no depth: connect the clip Depth, give a Depth file, or take alpha as depth");
}

Result<DepthOfFrame> in_metres(const DepthQuestion& q, std::vector<float> stored) {
    const Values& v = *q.values;
    if (v.depth_kind == DepthKind::CocPx) {
        for (float& radius : stored) radius = float(radius * q.scale.x);
        return DepthOfFrame{std::move(stored), true};
    }
    const Place place{q.frame->rect({q.frame->display}), q.frame->rect(q.source->bounds()),
                      q.frame->pixel_aspect};
    const View<float> plane(stored.data(), q.source->width(), q.source->height(), q.source->width());
    const auto done = depth_to_planar_metres(plane, place, settings_of(v));
    if (!done) return done.error();
    return DepthOfFrame{std::move(stored), false};
}

}  // namespace

Result<DepthOfFrame> depth_of(const DepthQuestion& question) {
    auto stored = stored_depth(question);
    if (!stored) return stored.error();
    return in_metres(question, std::move(*stored));
}

Result<DepthOfFrame> plate_depth_of(const DepthQuestion& question) {
    auto stored = of_clip(question, kPlateDepthClip);
    if (!stored) return stored.error();
    return in_metres(question, std::move(*stored));
}

std::vector<float> mask_of(const DepthQuestion& q) {
    if (!is_connected(q.effect, kMaskClip)) return {};
    const LentImage mask(q.effect, kMaskClip, q.time);
    if (!mask.is_readable()) return {};
    return plane_like(*q.source, [&](int x, int y) {
        return std::clamp(mask.value(x, y, mask.channels() - 1, 0), 0.0f, 1.0f);
    });
}

}  // namespace petzval::plugin
