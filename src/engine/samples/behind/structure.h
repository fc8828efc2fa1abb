// The structure of visible surfaces: boards, stripes and rims look alike along one direction.
#pragma once

#include "engine/samples/behind/known_surfaces.h"

namespace petzval::engine {

class SurfaceStructure {
public:
    // Measures the surfaces beside silhouettes; where several meet, the farthest.
    SurfaceStructure(const KnownSurfaces& known, const Mixtures& mixtures, Workers& workers);

    // A direction's vector of length 1 with twice its angle, which opposite directions share.
    static Direction doubled(Direction d) { return {d.x * d.x - d.y * d.y, 2 * d.x * d.y}; }

    // 0…1: how alike the surface at `from` continues in a direction. 1 along its structure, and in all
    // directions where it has none.
    float continues(KnownSurfaces::Place from, Direction doubled) const;

private:
    static constexpr int kCell = 4;  // side of a cell in pixels
    // Sums over pixels of one surface: squared change of light, its difference between the axes and between
    // the diagonals (structure tensor: W. Foerstner and E. Guelch 1987), and squared light.
    struct Changes {
        float coc_px = -1e30f;
        float all = 0, axes = 0, diagonals = 0, light = 0;
    };
    static Changes in_cell(const KnownSurfaces& known, int cell_x, int cell_y);
    Direction around(int cell_x, int cell_y) const;

    Image<Changes> cells_;
    // Per cell, the direction of the largest change, doubled. Its length, 0…1, is its coherence: 1 if the
    // light changes in this direction alone.
    Image<Direction> across_;
};

}  // namespace petzval::engine
