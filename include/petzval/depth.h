// Kinds of a renderer's depth channel, and their conversion to planar metres.
#pragma once

#include "petzval/deep.h"
#include "petzval/export.h"
#include "petzval/image.h"
#include "petzval/place.h"
#include "petzval/result.h"
#include "petzval/workers.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

enum class DepthKind {
    Planar,      // distance along the optical axis
    Ray,         // distance from the pinhole to the point
    Inverse,     // 1 / planar; with a range 0…1, 0 = range far, 1 = range near, linear in 1 / planar: the
                 // affine disparity of stereo and of networks
    Normalized,  // 0 = range near, 1 = range far, linear in planar depth
    Device,      // z-buffer value, linear in 1/z: 0 = range near, 1 = range far; far < near is reversed z,
                 // and an infinite end is allowed
    Mist,   // Blender's mist pass, falloff quadratic: the square of the fraction of the way from range near
            // (0) to range far (1), by distance from the pinhole
    CocPx,  // already a signed circle-of-confusion radius in pixels, + is far
    MistLinear,   // as Mist, with Blender's falloff Linear: the fraction itself
    MistInverse,  // as Mist, with Blender's falloff Inverse Quadratic: the square root of the fraction
};

// True for Blender's mist pass of any falloff.
constexpr bool is_mist(DepthKind kind) {
    return kind == DepthKind::Mist || kind == DepthKind::MistLinear || kind == DepthKind::MistInverse;
}

// Treatment of silhouettes that are ramps instead of steps, as in depth of neural networks or in filtered
// and enlarged passes. No surface lies at the depth of a pixel in a ramp.
enum class DepthEdges {
    Auto,  // snap where most silhouettes are soft or many are antialiased; exact depth keeps its bits
    Keep,  // use every value unchanged
    Snap,  // give each pixel of a ramp to the nearer or the farther side: in wide ramps by its colour and
           // place, in antialiased depth by its depth
};

struct DepthSettings {
    DepthKind kind = DepthKind::Planar;
    double unit_scale_m = 1;  // metres per unit of the channel, > 0
    // In metres per unit_scale_m. Normalized, Device and Mist need both, Inverse may have both.
    std::optional<double> range_near, range_far;
    std::optional<double> focal_length_mm, sensor_width_mm;  // Ray and Mist need both: the angle of a pixel
    int threads = 0;             // 0: all this process may use; the result never depends on it
    Workers* workers = nullptr;  // a host's, instead of `threads`; null: our own
};

struct DepthReport {
    std::size_t misses = 0;      // inf, NaN, <= 0 (where not negated), >= 1e10, half-float maximum
    std::size_t non_finite = 0;  // NaN and infinities as read
    float nearest_m = 0, farthest_finite_m = 0;
    std::vector<std::string> warnings;
};

// Depth of few codes, as files of 8 or 16 bits hold it: joins plateaus of neighbouring codes, which are one
// surface. Each value moves by at most half a step; steps of more are edges and stay. Returns the step
// between codes; 0, and nothing changes, if the values have none. `are_codes`: they were whole numbers
// (Frame::depth_is_share). Call it before depth_to_planar_metres(), as petzval defocus does for flat
// pictures.
PETZVAL_API float join_depth_codes(Plane& depth, const DepthSettings& settings, bool are_codes);

// Rewrites a depth channel in place as planar metres; a miss becomes +infinity.
//
// A value is a miss if it is NaN, infinite, of size >= 1e10 or 65504 (the largest half), 0 (except where it
// is an end of a range), or if its planar depth is not > 0. The plane covers the data window of `place`,
// which Ray needs to know the axis. If every finite value is negative, absolute values are taken; otherwise
// negative values are misses; either way with one warning. CocPx is not a depth: InvalidArgument. Errors:
// InvalidArgument naming the flag that is missing or out of range.
PETZVAL_API Result<DepthReport> depth_to_planar_metres(View<float> depth, const Place& place,
                                                       const DepthSettings& settings);

// Rewrites a channel of kind CocPx in place as signed radii in pixels: with a range, 0…1 stand for its two
// radii. A radius that is not finite becomes 0 (sharp), with one warning. Errors: InvalidArgument for a range
// of equal or infinite radii.
PETZVAL_API Result<DepthReport> depth_to_radii_px(View<float> depth, const DepthSettings& settings);

// Checks that depth of whole numbers (Frame::depth_is_share) has a meaning. Errors: InvalidArgument for radii
// without a range, and for planar distances unless `kind_given` states that a user chose them.
PETZVAL_API Status check_depth_codes(const DepthSettings& settings, bool kind_given);

// The same for both depths of every deep sample; samples stay nearest first. Each sample counts as a pixel
// does.
PETZVAL_API Result<DepthReport> deep_to_planar_metres(DeepPicture& deep, const Place& place,
                                                      const DepthSettings& settings);

}  // namespace petzval
