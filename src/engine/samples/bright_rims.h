// Rims of bright things. A renderer filters the colour of a lamp over its edge, but the depth of a pixel is
// that of one point: beside a lamp in focus a ring of its light has the depth of what is behind, and would be
// spread by that into a disc. hidden.h takes all silhouettes apart, for final frames; this is for previews.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include <optional>
#include <vector>

namespace petzval::engine {

// A pixel that shows the farther surface, in light of a brighter nearer one:
//     colour = near + (1 - share) far.
struct BrightRim {
    int x = 0;
    float share = 0;  // of the pixel that the nearer surface covers
    float near_coc_px = 0;
    Rgba near, far;  // near: premultiplied by the share
};

class BrightRims {
public:
    BrightRims() = default;  // there are none
    // Only where both are plain: twice as bright pixels of the nearer surface touch this one, and no clean
    // pixel of the farther one around is half as bright.
    static BrightRims find(View<const Rgba> colour, View<const float> coc_px, Workers& workers);
    // How far what decides about a pixel may lie from it.
    static constexpr int kReachPx = 4;

    bool empty() const { return index_.empty(); }
    const BrightRim* at(int x, int y) const {
        if (index_.empty() || index_(x, y) < 0) return nullptr;
        return &rims_[std::size_t(index_(x, y))];
    }
    // The radii where rims are spread as the nearer surface, whose light is most of theirs.
    Plane radii(View<const float> coc_px) const;

private:
    Image<int> index_;  // into the rims, or -1; empty: there are none
    std::vector<BrightRim> rims_;
};

}  // namespace petzval::engine
