// Ends of picture edges: where something nearer begins to hide one.
#pragma once

#include "engine/samples/hidden.h"
#include "engine/samples/outlines/edge_points.h"

#include <vector>

namespace petzval::engine {

// A straight edge of the picture that a nearer surface hides from `at` on.
struct EdgeEnd {
    PixelAt at;
    // Offset of the edge from the pixel's middle; kept apart, so that strips of a frame round alike.
    float off_x, off_y;
    float into_x, into_y;  // direction of the continuation, of length 1
    bool bright_is_right;  // true if its brighter side lies to the right of the continuation (y points down)
    float coc_px;          // radius of its surface
    float slope;           // change of that radius per px of the continuation
    float strength;        // 0…1, by its contrast and the length that is visible
    float known_px;        // distance at which its direction errs by end_px

    // The pixel that the continuation reaches after t pixels.
    PixelAt ahead(float t) const;
};

// The edges of a picture on surfaces without lamps. radii_px and white: as for CutEdges.
class EdgeEnds {
public:
    // Borrows radii_px.
    EdgeEnds(const LitPicture& picture, View<const float> radii_px, const Mixtures& mixtures, float white,
             Workers& workers)
        : points_(picture, radii_px, mixtures, white, workers) {}

    // Every end on a surface blurred by at most to_px, ordered by rows.
    std::vector<EdgeEnd> find(const Mixtures& mixtures, float to_px, Workers& workers) const;
    // Returns the length over which the edge continues until its surface becomes visible, or a farther one
    // does, because its own has ended; at most continues_px.
    float hidden_px(const EdgeEnd& end) const;

private:
    bool end_at(const EdgePlace& start, int side, EdgeEnd& end) const;
    bool goes_behind(const EdgeEnd& end) const;

    EdgePoints points_;
};

}  // namespace petzval::engine
