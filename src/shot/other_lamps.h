// Lamps that other pictures of the same things show.
#pragma once

#include "petzval/seen_elsewhere.h"
#include "petzval/shot.h"

#include "shot/landing.h"

#include <map>
#include <utility>
#include <vector>

namespace petzval::shot {

// Finds lamps in neighbouring frames. A renderer filters light over a pixel, but depth is that of one point.
// A lamp narrower than a pixel, or half behind an edge, has the depth of its surroundings in one frame and
// its own depth in the next, and its blur would change.
class OtherLamps {
public:
    explicit OtherLamps(const Shot& shot) : shot_(shot) {}

    // Those that have a depth of their own in `other`, whose pixels land so in the shot; what earlier
    // pictures said stays. share: of its light, that one has here which nothing shows. 0…1.
    void add(const Shot& other, const Image<Landing>& landings, float share, Workers& workers);

    // Lamps for lit pixels in which nothing has the lamp's depth, in the pixel's colour.
    std::vector<SeenElsewhere::Lamp> depths() const;
    // Adds hidden lamps in front of known farther surfaces: one sample per pixel of the shot.
    void hide(std::vector<DeepSample>& known) const;

private:
    void place(Rgba light, const Landing& at, float share);

    const Shot& shot_;
    std::map<std::pair<int, int>, float> depths_m_;  // by row and column
    std::map<std::pair<int, int>, DeepSample> hidden_;
};

}  // namespace petzval::shot
