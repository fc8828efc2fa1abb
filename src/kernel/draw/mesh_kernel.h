// Kernels of any pupil and any aberration: the pupil is cut into small cells, and each cell's light is spread
// evenly over the place where its corners land.
//
// The mesh is polar about the outline's centroid and follows the outline, so no cell is cut. Cells folded
// over by a caustic keep their energy, and neighbours share edges: the image has no gaps and no grain.
#pragma once

#include "kernel/draw/pupil.h"
#include "kernel/model/coverage.h"
#include "kernel/model/spread.h"

#include <functional>
#include <span>
#include <vector>

namespace petzval::kernel {

struct MeshPupil {
    std::vector<Point> outline;  // convex, positive area, edges of even length
    // 0…1, mean over a square; empty: 1 everywhere.
    std::function<double(Point middle, double half_width)> transmission;
    int rings = 16;
    // Light per area at points, where it is smooth over the pupil; empty: 1 everywhere.
    std::function<void(std::span<const Point> pupil, double* light)> density = {};
};

struct MeshBand {
    Light weight;  // share of the channels
    // Landing points of pupil points, in pixels; landed has room for one per point.
    std::function<void(std::span<const Point> pupil, Point* landed)> land;
};

// Channels sum to 1; colours are not mapped.
PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands);

// The part of the same kernel that lands within a window; nothing if all lands beside it.
PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands, const Rect& window);

// Resolution of the mesh for a kernel that reaches size_px: cells two pixels thick (three at 200 px), chords
// 0.05 px off their arcs. Rings; the longest distance of a chord of the outline from its arc, and its longest
// edge, pupil radii.
int mesh_rings(double size_px);
double mesh_tolerance(double size_px);
double mesh_step(double size_px);

// A mesh for `outline`, with the pupil's texture where it has one, and then fine enough to show it.
// size_px: how far the kernel reaches; bend_px: the same, more where aberrations bend across the pupil.
MeshPupil mesh_pupil(const Pupil& pupil, const std::vector<Point>& outline, double size_px, double bend_px);

// Cuts edges longer than `longest` into equal parts.
std::vector<Point> subdivided(const std::vector<Point>& outline, double longest);

}  // namespace petzval::kernel
