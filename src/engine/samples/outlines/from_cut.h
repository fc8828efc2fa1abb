// Positions relative to an edge of the picture that an occluder cuts.
#pragma once

#include "engine/samples/outlines/cut_edges.h"
#include "engine/samples/outlines/edge_end.h"

namespace petzval::engine {

// A point in the coordinates of an edge or of an end of one, px.
struct FromCut {
    float ahead, aside;
    template <typename Cut>
    FromCut(const Cut& cut, float x, float y)
        : ahead((x - cut.off_x) * cut.into_x + (y - cut.off_y) * cut.into_y),
          aside((y - cut.off_y) * cut.into_x - (x - cut.off_x) * cut.into_y) {}
    FromCut(const CutEdges::Edge& edge, CutEdges::Point p)
        : FromCut(edge, float(p.x - edge.at.x), float(p.y - edge.at.y)) {}
    FromCut(const EdgeEnd& from, const EdgeEnd& to)
        : FromCut(from, float(to.at.x - from.at.x) + to.off_x, float(to.at.y - from.at.y) + to.off_y) {}
};

}  // namespace petzval::engine
