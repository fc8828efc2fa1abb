// Joins the ends of edges that an occluder cuts.
#pragma once

#include "engine/samples/outlines/cut_edges.h"
#include "engine/samples/outlines/edge_end.h"

#include <vector>

namespace petzval::engine {

// Two ends that face each other on one line become one edge; each other end continues as far as its direction
// is known. width, height: of the picture, px.
std::vector<CutEdges::Edge> joined_edges(const EdgeEnds& edges, std::vector<EdgeEnd> ends, int width,
                                         int height, Workers& workers);

}  // namespace petzval::engine
