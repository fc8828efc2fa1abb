// Can the lens see it? The visibility of a point of the picture through points of the pupil.
#pragma once

#include "engine/reference/bright_points.h"
#include "engine/reference/surfaces.h"
#include "kernel/model/lens_model.h"

namespace petzval::engine {

// A source at the centre of a pixel, and the surfaces that its rays can meet on the way to the lens.
struct RaySource {
    double x = 0, y = 0;  // picture coordinates, pixel centres at +0.5
    double coc_px = 0;
    double nearest_coc_px = 0;  // of all surfaces in reach; >= coc_px: none is in the way
    int in_front = 0;           // facets of its own pixel that dim it, however close behind them it lies
    bool is_free() const { return in_front == 0 && nearest_coc_px >= coc_px; }
};
RaySource ray_source(const Surfaces& surfaces, int x, int y, double coc_px, double pupil_reach);

// Follows the ray that leaves the source through pupil point (u, v) (pixel orientation, y down) towards the
// lens. Where it has come to radius c it is at
//     q(c) = (x, y) + (coc_px - c) (u, v)
// (docs/conventions.md, "The definition", seen from the source). Returns the share of it that gets
// there. Facets nearer than the source that cross it stop it; a partly covering one stops its share where
// facets dim what is behind them, else all of it if its coverage exceeds `chance` (0…1).
float share_seen(const Surfaces& surfaces, const RaySource& source, double u, double v, float chance);

// The kernel of the point, each weight multiplied by the share of its rays that nothing hides.
kernel::PointSpread visible_point_spread(const Surfaces& surfaces, const kernel::LensModel& lens,
                                         kernel::FieldPosition field, const BrightPoint& point,
                                         double pupil_reach);

}  // namespace petzval::engine
