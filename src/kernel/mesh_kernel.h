// Kernels of any pupil and any aberration: the pupil is cut into small cells, and each cell's light is spread
// evenly over the place where its corners land.
//
// The mesh is polar about the outline's centroid and follows the outline, so no cell is cut. Cells folded
// over by a caustic keep their energy, and neighbours share edges: the image has no gaps and no grain.
#pragma once

#include "kernel/coverage.h"
#include "kernel/spread.h"

#include <functional>
#include <span>
#include <vector>

namespace petzval::kernel {

struct MeshPupil {
    std::vector<Point> outline;                 // convex, positive area, edges of even length
    std::function<double(Point)> transmission;  // 0…1; empty: 1 everywhere
    int rings = 16;
};

struct MeshBand {
    Light weight;  // share of the channels
    // Where points of the pupil land, in pixels; landed has room for one per point.
    std::function<void(std::span<const Point> pupil, Point* landed)> land;
};

// Channels sum to 1; colours are not mapped.
PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands);

// How fine a mesh must be for a kernel that reaches size_px: cells two pixels thick, chords 0.04 px off their
// arcs. Rings; the longest distance of a chord of the outline from its arc, and its longest edge, pupil
// radii.
int mesh_rings(double size_px);
double mesh_tolerance(double size_px);
double mesh_step(double size_px);

// Cuts edges longer than `longest` into equal parts.
std::vector<Point> subdivided(const std::vector<Point>& outline, double longest);

}  // namespace petzval::kernel
