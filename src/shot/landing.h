// Where what one picture shows lies in another of the same things: by cameras and depth, by motion vectors.
#pragma once

#include "petzval/result.h"
#include "petzval/seen_elsewhere.h"
#include "petzval/shot.h"
#include "petzval/workers.h"

#include "base/parallel.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace petzval::shot {

constexpr float kOneDepth = 1.02f;   // of one surface, seen from two places
constexpr float kOneSurface = 1.1f;  // from pixel to pixel, in depth
constexpr float kSilhouette = 1.3f;  // within 3 x 3 pixels

// In pixels of the data window; depth_m <= 0: not known, or behind the camera.
struct Landing {
    float x = 0, y = 0, depth_m = 0;
};

// Between which depths a pixel's own surface lies: inside a surface those around it, at a silhouette its own.
struct Bounds {
    Plane nearest, farthest;
};
Bounds bounds_of(View<const float> depth, Workers& workers);

// JustBehind: hidden by what is so near that it may be the same thing, moved by itself.
enum class Verdict : std::uint8_t { Unknown, Agrees, InFront, JustBehind, Hidden };
Verdict verdict_of(const Landing& at, const Bounds& bounds);

// Whether a pixel has the colour of where it lands. Requires: it lands within the shot.
bool look_alike(const Shot& other, int x, int y, const Shot& shot, const Landing& at);

struct Landings {
    Image<Landing> of_pixels;  // of the other picture
    bool by_motion = false;
    std::string warning;  // of motion vectors that were not used; else empty
};
// Of the pixels of `other` in `shot`. Its motion vectors go from frame to frame, by those of `all` that lie
// between where their surface is seen there; without them, and for misses, cameras and depth decide. Errors:
// InvalidArgument where the picture cannot be used, and why.
Result<Landings> landings_of(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot,
                             const Bounds& bounds, Workers& workers);

// Errors: InvalidArgument for a shot without depth in metres, without that and a camera with its matrix.
Status check_depth(const Shot& shot);
Status check_eye(const Shot& shot);

template <typename Body>
void for_rows(int rows, Workers& workers, const Body& body) {
    constexpr int kRows = 16;
    parallel_for((rows + kRows - 1) / kRows, workers, [&](int block) {
        for (int y = block * kRows; y < std::min(rows, (block + 1) * kRows); ++y) body(y);
    });
}

}  // namespace petzval::shot
