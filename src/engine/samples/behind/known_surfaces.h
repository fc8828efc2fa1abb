// The visible surfaces of a picture, and how far each may continue behind an occluder.
#pragma once

#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"
#include "engine/samples/outlines/cut_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::engine {

// True if two pixels, some distance apart, may show one surface.
inline bool one_surface(float coc_a_px, float coc_b_px) {
    return std::abs(coc_a_px - coc_b_px) < completion_model.apart_px();
}

// Radii behind the threshold of a silhouette that show the farther of the two surfaces that meet there.
struct FarSide {
    float beyond_px, most_px;
    bool shows(float coc_px) const { return coc_px > beyond_px && coc_px <= most_px; }
};

// The far side as a pixel at own_px sees it. If that pixel shows the farther surface, what differs from it by
// a silhouette's step is another one, such as a sign before a wall. Backwards there is even less room: an
// eighth of the step at this silhouette, of which own_px lies half behind the threshold.
inline FarSide far_side(float own_px, float threshold_px) {
    if (own_px <= threshold_px) return {threshold_px, std::numeric_limits<float>::infinity()};
    const float step_px = completion_model.between_px();
    const float slope_px = completion_model.third_surface * (own_px - threshold_px);
    return {std::max(threshold_px, own_px - step_px), own_px + std::min(step_px, slope_px)};
}

struct Direction {
    float x, y;  // a vector of length 1
};

class KnownSurfaces {
public:
    // Borrows the picture and the mixtures at its silhouettes. white: level of bright light, scene-linear
    // luminance (engine/samples/white.h); 0: no light is bright. edges_to_px: as in FillRule.
    KnownSurfaces(const LitPicture& picture, View<const float> coc_px, const Mixtures& mixtures, float white,
                  Workers& workers, float edges_to_px = FillRule{}.edges_to_px);

    // Signed radius of each pixel's visible surface; far in front of everything at silhouette pixels of the
    // nearer surface, which are not usable.
    View<const float> radii() const { return radii_; }
    // True if what the pixel hides is known: that counts as visible.
    bool is_patch(int x, int y) const { return picture_.is_patch(x, y); }
    // Colour of the farther surface at a silhouette, without lamps.
    Rgba colour(int x, int y) const {
        if (is_patch(x, y)) return picture_.dim(x, y, picture_.patches.colour(x, y));
        const Mixture* m = mixtures_.at(x, y);
        return m ? m->far_colour : picture_.dim(x, y);
    }
    // Scene-linear luminance from which light counts as bright; 0: none does.
    float white() const { return white_; }
    // The colour, no brighter than white.
    Rgba dim_colour(int x, int y) const {
        Rgba c = colour(x, y);
        const float light = luminance(c), share = white_ > 0 && light > white_ ? white_ / light : 1;
        c.r *= share;
        c.g *= share;
        c.b *= share;
        return c;
    }
    bool shows(int x, int y, float coc_px) const {
        return radii_.rect().contains(x, y) && std::abs(radii_(x, y) - coc_px) < completion_model.step_px;
    }

    // Change of the radius per pixel, from pixels around that continue the surface; 0 where none does.
    Slope slope(int x, int y) const;

    // A pixel that shows a surface.
    struct Place {
        int x, y;
        float coc_px;
    };
    // Colour of the surface at `from`, continued against `outwards` over `distance_px` into the hidden area.
    // Bright light is reduced towards the light of the surface beyond it (outwards from here), and more so if
    // its visible part is short compared with the distance. So a light fades as it slips behind an edge.
    // edges: around the hidden pixel.
    Rgba going_on(Place from, Direction outwards, float distance_px, const CutEdges::Around& edges) const;
    // Edges of the picture that continue around the hidden pixel (x, y).
    CutEdges::Around edges_around(int x, int y) const { return edges_.around({x, y}); }
    // Those of the surface at coc_px, between the pixel and visible ones within within_px.
    CutEdges::Around edges_around(int x, int y, float within_px, float coc_px) const {
        return edges_.around({x, y}, within_px, coc_px);
    }

private:
    void add_patches(Workers& workers);
    Rgba shown(Place from, Direction outwards, float distance_px, Rgba otherwise,
               const CutEdges::Around& edges) const;

    const LitPicture& picture_;
    const Mixtures& mixtures_;
    Plane radii_;
    float white_;
    CutEdges edges_;
};

// fill_hidden() with bright light that fades by its visible width.
HiddenLayers fill_hidden(const LitPicture& picture, View<const float> coc_px,
                         View<const unsigned char> connected, const Mixtures& mixtures, float nearest_coc_px,
                         float farthest_coc_px, const FillRule& rule, float white, Workers& workers);

}  // namespace petzval::engine
