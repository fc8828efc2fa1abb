#include "session/rendered/empty_pixels.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
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

// Depths, or radii, and alpha in one row.
struct RowContents {
    float farthest = -kInfinity;      // value of a pixel that is not empty
    float nearest_empty = kInfinity;  // value of an empty pixel
    float least_alpha = kInfinity, most_alpha = -kInfinity;
    bool has_light = false;

    bool has_alpha() const { return most_alpha > 0; }
    void add(const RowContents& other) {
        farthest = std::max(farthest, other.farthest);
        nearest_empty = std::min(nearest_empty, other.nearest_empty);
        least_alpha = std::min(least_alpha, other.least_alpha);
        most_alpha = std::max(most_alpha, other.most_alpha);
        has_light = has_light || other.has_light;
    }
};

RowContents contents_of(const Rgba* colour, const float* depth, int width, bool is_radii) {
    RowContents found;
    for (int x = 0; x < width; ++x) {
        found.least_alpha = std::min(found.least_alpha, colour[x].a);
        found.most_alpha = std::max(found.most_alpha, colour[x].a);
        if (!is_empty(colour[x])) {
            found.farthest = std::max(found.farthest, depth[x]);
            found.has_light = true;
        } else if (is_stated(depth[x], is_radii)) {
            found.nearest_empty = std::min(found.nearest_empty, depth[x]);
        }
    }
    return found;
}

// Engines clamp alpha. Codes of 8 bits, and sums of passes, are alphas far above 1.
std::string warning_of_alpha(const RowContents& all) {
    if (!all.has_alpha() && all.has_light)
        return "the picture has an alpha of 0 in every pixel: its light is a glow that hides nothing";
    if (all.least_alpha >= -2 * kNothing && all.most_alpha <= 1 + 2 * kNothing) return "";
    std::array<char, 120> text{};
    std::snprintf(text.data(), text.size(),
                  "the picture has alpha from %.3g to %.3g: values below 0 count as 0, above 1 as 1",
                  double(all.least_alpha), double(all.most_alpha));
    return text.data();
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
    for (const RowContents& row : rows) all.add(row);
    EmptyFar far{{}, warning_of_alpha(all)};
    const float behind = is_radii ? all.farthest : kInfinity;
    if (!all.has_alpha() || !(all.nearest_empty < behind)) return far;
    far.plane = Plane::uninitialised(depth.width(), depth.height());
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
