// Glare as a device draws it: light taken, and light thrown.
#pragma once

#include "petzval/image.h"

#include "glare/light.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace petzval::glare {

// Gaussians of a pyramid. Halving averages with weights 1 3 3 1 along each axis, doubling interpolates with
// the same; beyond its border a level continues as its mirror image, the border pixel repeated.
struct BloomPlan {
    struct Blur {
        int level = 0;                    // pixels 2^level wide
        std::vector<float> across, down;  // weights around the middle, an odd count that sums to 1
    };
    // Blurs of equal light, the widest first: on no finer a level than the next.
    std::vector<Blur> blurs;
    int coarsest = 0;  // level; the finest is the picture, its sides grown to whole pixels of this one
    float share() const { return 1 / float(blurs.size()); }
    // Size of a side of the finest level.
    int padded(int pixels) const {
        const int unit = 1 << coarsest;
        return (pixels + unit - 1) / unit * unit;
    }
};

// out(x, y) += weight * in(x + dx, y + dy)
struct StarTap {
    int dx = 0, dy = 0;
    Rgba weight;
};

// One spike of the quick star, on cells of reduction x reduction pixels: passes that follow each other,
// nothing beyond the frame.
struct Streak {
    int reduction = 1;
    float parts = 1;  // equal ones of the star's light, of which it throws one
    std::vector<std::vector<StarTap>> passes;
};

// A kernel as pictures are convolved with it: the transform of each channel, real as the kernel is symmetric.
struct Filter {
    int reach = 0;  // px to every side
    int size = 0;   // points a side of its transforms
    std::vector<float> r, g, b;
    std::size_t bytes() const { return 3 * r.size() * sizeof(float); }
};

// Amounts are shares of the light, those of `star` and `ghosts` of the highlights above the threshold, that
// of `bloom` of those above its own.
struct GlarePlan {
    float bloom = 0, star = 0, ghosts = 0, veil = 0;
    float threshold = 1, bloom_threshold = 0;
    // Sum of the parts' amounts, and bloom of its highlights; with threshold 0 that is in of_all.
    float of_all = 0, of_highlights = 0, of_bloom_light = 0;
    BloomPlan bloom_layers;                // where bloom > 0
    std::vector<Streak> streaks;           // where star > 0, either these, by reduction,
    std::shared_ptr<const Filter> filter;  // or this
    View<const Rgba> ghost_light;          // where ghosts > 0, of the picture's size
};

}  // namespace petzval::glare
