// Ends of outlines: where something nearer begins to hide one.
#pragma once

#include "petzval/image.h"

#include "engine/samples/outlines/arc.h"

#include <array>
#include <optional>
#include <span>

namespace petzval::engine {

struct PixelAt {
    int x, y;
};

// Relation of a pixel's visible surface to another surface.
enum class DepthSide { Nearer, Same, Farther };
DepthSide depth_side(float coc_px, float surface_px);
// Nothing is known beyond the picture: it counts as nearer.
DepthSide depth_side(View<const float> coc_px, PixelAt pixel, float surface_px);

constexpr int kTracedPx = 32;      // longest part of an outline that decides its continuation
constexpr int kLeastTracedPx = 5;  // shortest part that decides without a partner
constexpr int kLeastJoinedPx = 2;  // shortest part that joins an end pointing at it
constexpr int kWellTracedPx = 18;  // a shorter part may turn a corner before the end

struct OutlineEnd {
    PixelAt at;                                // a corner of pixels: that of (x, y) that is nearest to (0, 0)
    float coc_px;                              // radius of the outline's surface
    bool same_is_left;                         // true if that surface lies to the left of the continuation
    Arc arc;                                   // continuation; its coordinates count from `at`
    int told_by;                               // number of traced points that determine `arc`; 0: none do
    std::array<PlanePoint, kTracedPx> traced;  // middles of pixel sides, from the hidden end backwards
    int traced_px;
};

// The outline that is hidden from the corner (x, y) of four pixels on, if three surfaces meet there: the
// outline between the middle and the farthest one. x is 1…width-1, y is 1…height-1.
std::optional<OutlineEnd> outline_end(View<const float> coc_px, int x, int y);

// Fits a line to the points, or an arc if the line does not explain them within the precision of pixel sides;
// start and into: as for fitted_line(). False: neither fits, and `best` is the arc.
bool fit_line_or_arc(std::span<const PlanePoint> points, PlanePoint start, PlanePoint into, Arc& best);

}  // namespace petzval::engine
