// All surfaces behind a pixel, in the order in which they hide each other.
#pragma once

#include "engine/samples/behind/near_silhouettes.h"
#include "engine/samples/behind/witnesses.h"

#include <vector>

namespace petzval::engine {

class SurfacesBehind {
public:
    // Borrows the picture, radii, connections and mixtures. nearest_px, farthest_px: radii of the frame.
    SurfacesBehind(const LitPicture& picture, View<const float> coc_px, View<const unsigned char> connected,
                   const Mixtures& mixtures, float nearest_px, float farthest_px, const FillRule& rule,
                   float white, Workers& workers);

    const KnownSurfaces& known() const { return known_; }
    bool may_hide(int x, int y) const { return near_silhouettes_.may_hide(x, y, coc_(x, y)); }
    // Appends the surfaces behind (x, y), nearest first. If no lens ray that passes the occluder reaches a
    // surface, nothing is appended. Returns about how far the next hidden outline is, px.
    float fill(int x, int y, std::vector<HiddenGuess>& hidden) const;

private:
    void stack(const HiddenPixel& here, Hits& hits, std::vector<HiddenGuess>& hidden) const;

    KnownSurfaces known_;
    SurfaceStructure structure_;
    HiddenOutlines outlines_;
    HiddenTextures textures_;
    View<const float> coc_;
    View<const unsigned char> connected_;
    const Mixtures& mixtures_;
    NearSilhouettes near_silhouettes_;
    SurfaceSearch search_;
    Witnesses witnesses_;
    // Every how many directions are searched, and are searched first.
    std::size_t every_, every_first_;
};

}  // namespace petzval::engine
