// The surfaces on both sides of a silhouette.
#pragma once

#include "engine/samples/hidden.h"
#include "engine/samples/silhouettes/two_surfaces.h"

namespace petzval::engine {

// The two surfaces that meet at a silhouette's pixel, from its neighbourhood.
struct Sides {
    Pool near_clean, far_clean, far_mixed;
    Rgba far_most;             // the most light of pixels that show the farther surface, by channel
    float near_brightest = 0;  // luminance of the brightest pixel that shows the nearer one, with its lamps
    float near_coc = 0, far_coc = 0;  // radius of the closest pixel on that side
    float near_closest = 1e9f, far_closest = 1e9f;
    float near_share_by_shape = 0;
};

// The sides around (x, y): pixels whose radius is at most threshold_px show the nearer one. stated: radii of
// the picture, coc: the same with strands made whole (bridges.h). touching: bits of touching.h.
Sides look_around(const LitPicture& picture, View<const float> coc, View<const float> stated,
                  View<const unsigned char> touching, int x, int y, float threshold_px,
                  const UnmixRule& rule);

// The colour of a thin thing that has no clean pixel: its pixels nearby count as they differ from the far
// side. Those that lamps light count only where there are no others: some of that light is left in them.
Guess least_like(Rgba far_colour, const LitPicture& picture, View<const float> coc,
                 View<const unsigned char> touching, int x, int y, float threshold_px);

}  // namespace petzval::engine
