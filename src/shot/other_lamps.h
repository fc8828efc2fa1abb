// Lamps that other pictures of the same things show.
#pragma once

#include "petzval/seen_elsewhere.h"
#include "petzval/shot.h"

#include "shot/landing.h"

#include <map>
#include <utility>
#include <vector>

namespace petzval::shot {

// A renderer filters light over a pixel, but the depth of a pixel is that of one point. A lamp narrower than
// a pixel, or half behind an edge, has the depth of what is around it in one frame and its own in the next,
// and would be blurred unlike.
class OtherLamps {
public:
    explicit OtherLamps(const Shot& shot) : shot_(shot) {}

    // Those that have a depth of their own in `other`, whose pixels land so in the shot; what earlier
    // pictures said stays. share: of its light, that one has here which nothing shows. 0…1.
    void add(const Shot& other, const Image<Landing>& landings, float share, Workers& workers);

    // Of pixels that one lights, in its colour, where nothing has its depth.
    std::vector<SeenElsewhere::Lamp> depths() const;
    // Those that are hidden, before what is known to lie farther behind: a sample of each of the shot's
    // pixels.
    void hide(std::vector<DeepSample>& known) const;

private:
    void place(Rgba light, const Landing& at, float share);

    const Shot& shot_;
    std::map<std::pair<int, int>, float> depths_m_;  // by row and column
    std::map<std::pair<int, int>, DeepSample> hidden_;
};

}  // namespace petzval::shot
