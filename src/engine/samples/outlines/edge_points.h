// Points on the edges of a picture.
#pragma once

#include "engine/samples/hidden.h"
#include "engine/samples/outlines/outline_end.h"

namespace petzval::engine {

// A pixel by its place along an edge that is followed row by row (upright) or column by column, and
// across it.
struct EdgePlace {
    bool upright;
    int along, across;
    PixelAt pixel() const { return upright ? PixelAt{across, along} : PixelAt{along, across}; }
    EdgePlace moved(int by_along, int by_across) const {
        return {upright, along + by_along, across + by_across};
    }
};
struct EdgePoint {
    float across = 0, energy = 0;  // its place in the row, and the sum of squared changes of light
    bool rises = false;            // true if light increases across
};

// The light of a picture without lamps, and where it changes most. radii_px and white: as for CutEdges.
class EdgePoints {
public:
    // Borrows radii_px.
    EdgePoints(const LitPicture& picture, View<const float> radii_px, const Mixtures& mixtures, float white,
               Workers& workers);

    View<const float> radii() const { return radii_; }
    // True if the pixel touches no silhouette. Requires: it lies in the picture.
    bool clean(PixelAt p) const { return light_(p.x, p.y) >= 0; }
    // True if the pixel shows something nearer than a surface at coc_px; true if it shows that surface alone.
    bool hides(PixelAt p, float coc_px) const;
    bool shows(PixelAt p, float coc_px) const;
    // True if the pixel shows, alone, something farther than a surface at coc_px.
    bool shows_farther(PixelAt p, float coc_px) const;
    // True if the light changes more at the place than beside it: `point` is then the centre of the change.
    bool at(const EdgePlace& place, EdgePoint& point) const;
    // Replaces `point` by the nearest one of its kind in the row of `place`, which is within_px from
    // `across`. Both count from the place.
    bool near(const EdgePlace& place, float across, float within_px, EdgePoint& point) const;

private:
    float change_at(const EdgePlace& place) const;

    View<const float> radii_;
    Plane light_;  // of each clean pixel, without lamps; -1 at silhouettes
    float dark_;
};

}  // namespace petzval::engine
