// The share of the pupil that nearer things cover, as one highlight sees it.
#pragma once

#include "petzval/image.h"

#include "engine/lights/shadow_plan.h"

#include <span>

namespace petzval::device {

// The pupil as a grid, whose cells are the taps of the highlight's disc, or equal parts of them if the disc
// has few.
class PupilShadow {
public:
    explicit PupilShadow(const engine::ShadowGrid& grid);

    void cover(std::span<const engine::SeenCaster> casters);

    // Call it after the last cover().
    void finish();
    // The share of the rays to each tap of a row that nothing stops, from tap (dx, dy) on; taps are counted
    // from the first one of the disc's square. Requires: finished.
    void visible(int dx, int dy, std::span<float> shares) const;

private:
    float visible(int x0, int y0) const;  // of the tap whose first cell this is

    float scale_;       // signed radius, as taps count it
    int taps_, parts_;  // along a side of the disc's square; cells along a tap
    Plane covered_;
    Plane visible_;  // by tap
};

}  // namespace petzval::device
