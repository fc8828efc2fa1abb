// Joins the colours and radii of the visible pixels around a hidden one to those of its surface.
#pragma once

#include "engine/samples/behind/search.h"
#include "engine/samples/behind/smooth.h"
#include "engine/samples/behind/structure.h"
#include "engine/samples/outlines/hidden_outlines.h"
#include "engine/samples/textures/hidden_textures.h"

namespace petzval::engine {

// A hidden pixel, and the outlines and edges around it.
struct HiddenPixel {
    int x, y;
    const HiddenOutlines::Around& outlines;
    CutEdges::Around edges;
};

// A surface met by the search, with weights by 1/distance.
struct Met {
    float all = 0, within = 0;  // weight of all hits, and of those inside the surface's own outline
    float unhidden = 0;         // weight of hits that no outline of a nearer surface hides
};

class Witnesses {
public:
    // Borrows all.
    Witnesses(const KnownSurfaces& known, const SurfaceStructure& structure, const HiddenTextures& textures,
              const SurfaceSearch& search)
        : known_(known), structure_(structure), textures_(textures), search_(search) {}

    // The estimate of the surface behind `here` to which the marked hits belong: the weighted mean of
    // their colours and radii. They are used up.
    HiddenGuess surface(const HiddenPixel& here, Hits& hits, Met& met) const;

private:
    class Votes;
    void add_pair(HiddenTextures::Point& hidden, const Found& a, const Found& b, std::size_t k, float weight,
                  Votes& votes) const;
    void add_alone(const HiddenPixel& here, HiddenTextures::Point& hidden, const Found& one, std::size_t k,
                   float nearest_px, float weight, Votes& votes) const;

    const KnownSurfaces& known_;
    const SurfaceStructure& structure_;
    const HiddenTextures& textures_;
    const SurfaceSearch& search_;
};

}  // namespace petzval::engine
