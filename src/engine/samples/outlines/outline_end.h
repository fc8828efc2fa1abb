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

constexpr int kTracedPx = 32;      // of an outline, at most, tell how it goes on
constexpr int kLeastTracedPx = 5;  // tell anything alone
constexpr int kLeastJoinedPx = 2;  // to where another end points

struct OutlineEnd {
    PixelAt at;                                // a corner of pixels: that of (x, y) that is nearest to (0, 0)
    float coc_px;                              // of its surface
    bool same_is_left;                         // of where it goes on: its surface
    Arc arc;                                   // how it goes on; places count from `at`
    int told_by;                               // so many of what was traced; 0: nothing tells
    std::array<PlanePoint, kTracedPx> traced;  // middles of pixels' sides, from where it is hidden on
    int traced_px;
};

// The outline that is hidden from the corner (x, y) of four pixels on, at 1…width-1 and 1…height-1: where
// three surfaces meet, of the middle one before the farthest.
std::optional<OutlineEnd> outline_end(View<const float> coc_px, int x, int y);

// Fits a line to the points, or an arc if the line does not explain them within the precision of pixel sides.
// False: neither fits.
bool line_or_arc(const FittedArc& line, const FittedArc& arc, Arc& best);

}  // namespace petzval::engine
