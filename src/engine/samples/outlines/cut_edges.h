// Edges of the picture that an occluder cuts: they continue behind it, straight. Two ends on one line are one
// edge.
#pragma once

#include "engine/samples/hidden.h"

#include <vector>

namespace petzval::engine {

class CutEdges {
public:
    // radii_px: radius of each pixel's visible surface, as in KnownSurfaces. white: level of bright light,
    // scene-linear luminance; 0: edges are not searched. to_px: edges are not searched on surfaces blurred by
    // more.
    CutEdges(const LitPicture& picture, View<const float> radii_px, const Mixtures& mixtures, float white,
             float to_px, Workers& workers);

    struct Point {
        int x, y;
    };
    // The edges that may continue near a hidden point. Borrows them.
    class Around;
    Around around(Point hidden) const;
    // Those of the surface at coc_px that may stand between the point and a colour within within_px.
    Around around(Point hidden, float within_px, float coc_px) const;
    // Not 0, so that weights remain if all colours lie behind some edge.
    static constexpr float kCut = 1e-3f;

    struct Edge {
        Point at;  // pixel where the edge is cut
        // Offset of the cut from its middle; kept apart, so that strips of a frame round alike.
        float off_x, off_y;
        float into_x, into_y;    // direction of the continuation, of length 1
        float length_px;         // it ends so far from its cut
        float coc_px, strength;  // 0…1
    };

private:
    void sort_into_cells(int width, int height);
    template <typename Counts>
    Around around(Point hidden, float within_px, const Counts& counts) const;

    std::vector<Edge> edges_;
    int columns_ = 0;
    std::vector<std::vector<int>> near_;  // per cell: numbers of the edges that may reach into it
};

class CutEdges::Around {
public:
    // Weight of a colour visible at `shown`, of a surface at coc_px, for the hidden point: 1 if nothing
    // stands between them, kCut behind a continuing edge.
    float passes(Point shown, float coc_px) const;

private:
    friend class CutEdges;
    struct Near {
        const Edge* edge;
        float aside, ahead;  // of the hidden point: to which side of the edge, and how far along it
    };
    std::vector<Near> near_;
};

}  // namespace petzval::engine
