// Kernels of any pupil and any aberration: the pupil is cut into small cells, and each cell's light is spread
// evenly over the place where its corners land.
//
// The mesh is polar about the outline's centroid and follows the outline, so no cell is cut. Cells folded
// over by a caustic keep their energy, and neighbours share edges: the image has no gaps and no grain.
#pragma once

#include "kernel/coverage.h"
#include "kernel/spread.h"

#include <functional>
#include <vector>

namespace petzval::kernel {

struct MeshBand {
    BandWeight weight;
    std::function<Point(Point)> landing_px;  // of a point of the pupil
};

struct MeshPupil {
    std::vector<Point> outline;                 // convex, positive area, edges of even length
    std::function<double(Point)> transmission;  // 0…1; empty: 1 everywhere
    int rings = 16;
};

// Channels sum to 1; colours are not mapped.
PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands);

// Rings that keep cells of a kernel of this size at most about 1.5 pixels thick.
int rings_for(double size_px);

// Cuts edges longer than `longest` into equal parts.
std::vector<Point> subdivided(const std::vector<Point>& outline, double longest);

}  // namespace petzval::kernel
