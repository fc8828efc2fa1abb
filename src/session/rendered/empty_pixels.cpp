#include "session/rendered/empty_pixels.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace petzval {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Half a code of 8 bits: lossy compression and the tails of filters leave less than this.
constexpr float kNothing = 1.0f / 512;

bool is_empty(Rgba c) { return std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b), c.a}) < kNothing; }

// False for a depth that is missing already; zeros stay, because depth may have been averaged with them.
bool is_stated(float depth, bool is_radii) { return is_radii || depth > 0; }

// Depths, or radii, in one row.
struct RowContents {
    float farthest = -kInfinity;      // value of a pixel that is not empty
    float nearest_empty = kInfinity;  // value of an empty pixel
    bool has_alpha = false, has_light = false;
};

RowContents contents_of(const Rgba* colour, const float* depth, int width, bool is_radii) {
    RowContents found;
    for (int x = 0; x < width; ++x) {
        found.has_alpha = found.has_alpha || colour[x].a > 0;
        if (!is_empty(colour[x])) {
            found.farthest = std::max(found.farthest, depth[x]);
            found.has_light = true;
        } else if (is_stated(depth[x], is_radii)) {
            found.nearest_empty = std::min(found.nearest_empty, depth[x]);
        }
    }
    return found;
}

}  // namespace

EmptyFar empty_far(const Rendered& rendered, Workers& workers) {
    const View<const Rgba> colour = rendered.colour;
    const View<const float> depth = depth_or_radii(rendered);
    const bool is_radii = has_radii(rendered);
    std::vector<RowContents> rows(std::size_t(depth.height()));
    parallel_for(depth.height(), workers, [&](int y) {
        rows[std::size_t(y)] = contents_of(colour.row(y), depth.row(y), depth.width(), is_radii);
    });
    RowContents all;
    for (const RowContents& row : rows) {
        all.farthest = std::max(all.farthest, row.farthest);
        all.nearest_empty = std::min(all.nearest_empty, row.nearest_empty);
        all.has_alpha = all.has_alpha || row.has_alpha;
        all.has_light = all.has_light || row.has_light;
    }
    if (!all.has_alpha && all.has_light)
        return {{}, "the picture has an alpha of 0 in every pixel: its light is a glow that hides nothing"};
    const float behind = is_radii ? all.farthest : kInfinity;
    if (!all.has_alpha || !(all.nearest_empty < behind)) return {};
    EmptyFar far{Plane::uninitialised(depth.width(), depth.height()), {}};
    parallel_for(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) {
            const float given = depth(x, y);
            const bool is_moved = is_empty(colour(x, y)) && given < behind && is_stated(given, is_radii);
            far.plane(x, y) = is_moved ? behind : given;
        }
    });
    return far;
}

Rendered EmptyFar::of(Rendered rendered) const {
    if (!plane.empty()) set_depth(rendered, plane);
    return rendered;
}

}  // namespace petzval
