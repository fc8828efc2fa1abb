// Positions of one picture's surfaces in another picture of the same objects: by cameras and depth, or by
// motion vectors.
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

// Depth range of a pixel's own surface: that of its neighbours inside a surface, its own depth at a
// silhouette.
struct Bounds {
    Plane nearest, farthest;
};
Bounds bounds_of(View<const float> depth, Workers& workers);

// JustBehind: hidden by something so near that it may be the same object, moving.
enum class Verdict : std::uint8_t { Unknown, Agrees, InFront, JustBehind, Hidden };
Verdict verdict_of(const Landing& at, const Bounds& bounds);

// True if a pixel has the colour of its landing position. Requires: it lands within the shot.
bool look_alike(const Shot& other, int x, int y, const Shot& shot, const Landing& at);

// True if the position is in the picture of that depth.
bool lands_within(const Landing& at, View<const float> depth);
// True if colours are alike and depths are those of one surface. Requires: it lands within the shot.
bool lands_alike(const Shot& other, int x, int y, const Shot& shot, const Landing& at);

struct Landings {
    Image<Landing> of_pixels;  // of the other picture
    bool by_motion = false;
    std::string warning;  // of motion vectors that were not used, or that fit with other signs; else empty
};
// Landing positions in `shot` of the pixels of `other`. Motion vectors lead from frame to frame through the
// frames of `all` in between, as long as they see the surface; without vectors, and for missing depth,
// cameras and depth decide. Errors: InvalidArgument with the reason if the picture cannot be used.
Result<Landings> landings_of(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot,
                             const Bounds& bounds, Workers& workers);

// Errors: InvalidArgument for a shot without depth in metres, without that and a camera with its matrix.
Status check_depth(const Shot& shot);
Status check_eye(const Shot& shot);

// "70 %", of 0.7.
std::string percent(double share);

template <typename Body>
void for_rows(int rows, Workers& workers, const Body& body) {
    constexpr int kRows = 16;
    parallel_for((rows + kRows - 1) / kRows, workers, [&](int block) {
        for (int y = block * kRows; y < std::min(rows, (block + 1) * kRows); ++y) body(y);
    });
}

}  // namespace petzval::shot
