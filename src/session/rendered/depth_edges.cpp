#include "session/rendered/depth_edges.h"

#include "base/parallel.h"
#include "depth/emptiness_edges.h"
#include "depth/filtered_edges.h"
#include "depth/soft_edges.h"
#include "engine/samples/all_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace petzval {
namespace {

// Values that are linear in 1/depth, as radii are.
Plane linear_values(View<const float> depth, bool is_radii, Workers& workers) {
    Plane values = Plane::uninitialised(depth.width(), depth.height());
    parallel_for(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) {
            const float v = depth(x, y);
            values(x, y) = is_radii ? (std::isfinite(v) ? v : 0) : float(1 / engine::finite_depth(double(v)));
        }
    });
    return values;
}

// Depth as it was averaged; 1e10 m, the sky of most renderers, for infinite.
Plane with_finite_sky(View<const float> depth, Workers& workers) {
    Plane values = Plane::uninitialised(depth.width(), depth.height());
    parallel_for(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x)
            values(x, y) = std::min(1e10f, float(engine::finite_depth(double(depth(x, y)))));
    });
    return values;
}

std::string in_words(const EdgeSoftness& softness, bool is_filtered) {
    if (!softness.is_soft())
        return std::string(is_filtered ? "the depth is antialiased; " : "") +
               "pixels between two depths were given to one of them; depth.edges keep leaves them as they "
               "are";
    char text[160];
    std::snprintf(text, sizeof text,
                  "soft depth edges (about %.0f px) were sharpened using the colour image; "
                  "depth.edges keep leaves them soft",
                  4 * double(softness.deviation_px));
    return text;
}

}  // namespace

HardDepth hard_depth(const Rendered& rendered, DepthEdges edges, Workers& workers) {
    HardDepth hard;
    if (edges == DepthEdges::Keep || (rendered.deep && !rendered.deep->empty())) return hard;
    const bool is_radii = has_radii(rendered);
    View<const float> given = depth_or_radii(rendered);
    Plane without_zeros;
    if (!is_radii && dips_before_emptiness(given, workers)) {
        without_zeros = without_dips(given, workers);
        given = without_zeros;
    }
    const Plane values = linear_values(given, is_radii, workers);
    const EdgeSoftness softness = edge_softness(values, workers);
    const bool is_filtered = !without_zeros.empty() || softness.is_filtered();
    if (edges == DepthEdges::Auto && !softness.is_soft() && !is_filtered) return hard;
    const auto replace = [&](Plane hardened, const Plane& before, bool is_inverse) {
        parallel_for(hardened.height(), workers, [&](int y) {
            for (int x = 0; x < hardened.width(); ++x) {
                float& v = hardened(x, y);
                if (v == before(x, y))
                    v = given(x, y);
                else if (is_inverse)
                    v = 1 / v;
            }
        });
        hard.plane = std::move(hardened);
    };
    if (softness.is_soft()) {
        replace(snapped_edges(rendered.colour, values, softness, workers), values, !is_radii);
    } else {
        constexpr float kLeastStep = 0.01f;  // of the range: what is less makes no difference in blur
        const float least = kLeastStep * softness.range;
        const Plane depth = is_radii ? values.clone() : with_finite_sky(given, workers);
        replace(without_filter(rendered.colour, {depth, values, is_radii, least}, workers), depth, false);
    }
    hard.what_was_done = in_words(softness, is_filtered);
    return hard;
}

Rendered HardDepth::of(Rendered rendered) const {
    if (!plane.empty()) set_depth(rendered, plane);
    return rendered;
}

}  // namespace petzval
