// Definitions of three terms: opaque, same surface, in front of. Code that decides by them uses a law from
// this file, so that each number stands once and beside its reason.
//
// Radii are signed circles of confusion in pixels, smaller is nearer.
#pragma once

#include "laws/casters.h"

#include <algorithm>
#include <cmath>

namespace petzval::laws {

// Opaque: coverage of at least so much hides what lies behind it.
constexpr float kOpaque = 1 - 1e-3f;       // coverage as files hold it: halves round by up to 5e-4
constexpr float kOpaqueAlone = 0.999f;     // of what is left of a pixel in front of its other samples
constexpr float kOpaqueElsewhere = 0.99f;  // of a pixel that other frames may use: they resample it
constexpr float kOpaqueLayer = 0.97f;  // with emptiness, in an interval of radius: later samples lie behind

// Sharp: a disc of this radius lies within its pixel.
constexpr float kWithinPixelPx = 0.5f;

// Same surface: two radii, `apart_px` pixels from each other, may lie on one. The radius changes by no more
// than `step_px` from one pixel to the next, by `relative` of the larger radius (what rounds it is relative,
// and so is blur that would show a gap), and by `slope` for each further pixel between them.
struct SurfaceLaw {
    float step_px = 0, relative = 0, slope = 0;
};
inline bool same_surface(const SurfaceLaw& law, float a_px, float b_px, float apart_px = 1) {
    const float largest = std::max(std::abs(a_px), std::abs(b_px));
    return std::abs(a_px - b_px) <= law.step_px + law.relative * largest + law.slope * (apart_px - 1);
}
constexpr SurfaceLaw kConnected{0.8f};     // narrower steps of blurred surfaces are not taken apart
constexpr SurfaceLaw kHiddenSheet{0.25f};  // of hidden samples: one of many leaves may lie beside any other
constexpr SurfaceLaw kOneSquare{kOneSquarePx};
constexpr float kJumpPx = 1;  // a step from pixel to pixel that a shadow shows

// The same in metres of depth, as ratios: files hold depths to 0.1 %, and a surface seen at a grazing angle
// changes by 10 % from pixel to pixel.
inline bool same_surface_by_depth(float ratio, float a_m, float b_m) {
    return a_m == b_m || std::max(a_m, b_m) <= ratio * std::min(a_m, b_m);
}
// Two depths that files state for one surface. Halves have 11 bits; far away, radii alone say too little: 110
// m and 112 m may be a hundredth of a pixel apart.
constexpr float kSameStatedPx = 0.02f, kSameStatedRatio = 1.001f;

// In front of: nearer by more than `by_px`, so that it hides what lies behind it.
inline bool is_in_front(float nearer_px, float farther_px, float by_px) {
    return nearer_px < farther_px - by_px;
}
// Step of a light that is dimmed tap by tap: the next pixels of a surface that slopes by less than a pixel of
// radius per pixel lie outside the pupil as the light sees them.
constexpr float kOwnTapPx = 0.02f;
constexpr float kOwnPupilPx = 1;  // of a light whose pupil is known in 8 x 8 points: its surface may tilt
constexpr float kOwnSurfacePx = 0.2f;  // engines take what is nearer by less for the light's own surface
constexpr float kNoRoomPx = 1;         // no ray comes between two samples of a pixel this close
constexpr float kHidesLittlePx = 3;    // what is nearer by less hides next to nothing of a wide disc

}  // namespace petzval::laws
