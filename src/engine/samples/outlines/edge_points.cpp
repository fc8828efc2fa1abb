#include "engine/samples/outlines/edge_points.h"

#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/nearest_pixel.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

EdgePoints::EdgePoints(const LitPicture& picture, View<const float> radii, const Mixtures& mixtures,
                       float white, Workers& workers)
    : radii_(radii),
      light_(Plane::uninitialised(radii.width(), radii.height())),
      dark_(completion_model.edge_dark * white) {
    parallel_for(light_.height(), workers, [&](int y) {
        float* const row = light_.row(y);
        for (int x = 0; x < light_.width(); ++x)
            row[x] = std::max(0.0f, luminance(comparable(picture.dim(x, y))));
        mixtures.for_each_in_row(y, [&](int x, const Mixture&) { row[x] = -1; });
    });
}

bool EdgePoints::hides(PixelAt p, float coc_px) const {
    return radii_(p.x, p.y) <= coc_px - completion_model.step_px;
}

bool EdgePoints::shows(PixelAt p, float coc_px) const {
    return radii_.rect().contains(p.x, p.y) && light_(p.x, p.y) >= 0 &&
           std::abs(radii_(p.x, p.y) - coc_px) < completion_model.step_px;
}

bool EdgePoints::shows_farther(PixelAt p, float coc_px) const {
    return clean(p) && radii_(p.x, p.y) > coc_px && !one_surface(radii_(p.x, p.y), coc_px);
}

// Relative change of the light across a pixel, -1…1; 0 unless one surface shows there.
float EdgePoints::change_at(const EdgePlace& place) const {
    const PixelAt p = place.pixel(), before = place.moved(0, -1).pixel(), after = place.moved(0, 1).pixel();
    if (!radii_.rect().contains(p.x, p.y)) return 0;
    const float coc_px = radii_(p.x, p.y);
    if (!shows(p, coc_px) || !shows(before, coc_px) || !shows(after, coc_px)) return 0;
    const float from = light_(before.x, before.y), to = light_(after.x, after.y);
    return (to - from) / (from + to + 2 * dark_);
}

// The change of an edge of two plain areas spreads over three pixels, and the top of a parabola through these
// is the edge. As it moves to the next pixel, the change of that one's neighbour comes in and that of the
// pixel left behind goes. A smaller part of the least contrast than one in edge_traced_px is noise: it
// neither starts nor prolongs an edge.
bool EdgePoints::at(const EdgePlace& place, EdgePoint& point) const {
    const float here = change_at(place), size = std::abs(here);
    if (!(size > 0)) return false;  // (nor is NaN an edge)
    const auto beside = [&](int by) {
        return std::max(0.0f, std::copysign(1.0f, here) * change_at(place.moved(0, by)));
    };
    const float before = beside(-1);
    if (before > size) return false;
    const float after = beside(1);
    if (after >= size) return false;
    const float across = 0.5f * (after - before) / (2 * size - before - after);
    const int side = across > 0 ? 1 : -1;
    const float next = beside(2 * side);
    const float left = across > 0 ? before : after;
    const float squares = before * before + size * size + after * after;
    const float energy = squares + std::abs(across) * (next * next - left * left);
    const float parts = completion_model.edge_traced_px;
    if (energy * parts * parts < completion_model.edge_change) return false;  // (both are squares)
    point = {across, energy, here > 0};
    return true;
}

bool EdgePoints::near(const EdgePlace& place, float across, float within_px, EdgePoint& point) const {
    const int middle = nearest_pixel(across);
    const bool rises = point.rises;
    float nearest = within_px;
    bool found = false;
    for (int c = middle - 1; c <= middle + 1; ++c) {
        EdgePoint p;
        if (!at(place.moved(0, c), p) || p.rises != rises) continue;
        p.across += float(c);
        const float off = std::abs(p.across - across);
        if (off < nearest) nearest = off, point = p, found = true;
    }
    return found;
}

}  // namespace petzval::engine
