#include "session/rendered/depth_edges.h"

#include "base/parallel.h"
#include "depth/soft_edges.h"
#include "engine/samples/all_samples.h"

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

std::string in_words(const EdgeSoftness& softness) {
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
    const View<const float> given = depth_or_radii(rendered);
    const Plane values = linear_values(given, is_radii, workers);
    const EdgeSoftness softness = edge_softness(values, workers);
    if (edges == DepthEdges::Auto && !softness.is_soft()) return hard;
    hard.plane = snapped_edges(rendered.colour, values, softness, workers);
    parallel_for(hard.plane.height(), workers, [&](int y) {
        for (int x = 0; x < hard.plane.width(); ++x) {
            float& v = hard.plane(x, y);
            if (v == values(x, y))
                v = given(x, y);
            else if (!is_radii)
                v = 1 / v;
        }
    });
    hard.what_was_done = in_words(softness);
    return hard;
}

Rendered HardDepth::of(Rendered rendered) const {
    if (!plane.empty()) set_depth(rendered, plane);
    return rendered;
}

}  // namespace petzval
