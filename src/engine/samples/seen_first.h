// The visible parts of one pixel's samples, for previews: those on a straight ray first, then those behind
// other samples.
#pragma once

#include "petzval/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace petzval::engine {

// True if the sample is hidden from rays that pass the edge in front of it. These rays see the surface that
// the pinhole sees beside the edge, unless the two radii lie on both sides of focus, where the rays cross.
inline bool is_hidden(float in_front_px, float coc_px) { return coc_px <= 0 || in_front_px >= 0; }

// The samples of a pixel, nearest first, in the order of a gather: the part on a straight ray first, then the
// part hidden by others. A sample right behind its occluder counts only with the area that the occluder
// leaves open. Few rays reach the rest, and the gather mixes the light of two rings, so the occluder would
// become transparent.
template <typename Emit>
class SeenFirst {
public:
    explicit SeenFirst(const Emit& emit) : emit_(emit) {}
    void operator()(Rgba colour, float coc_px, float covered) {
        const float seen = std::min(covered, open_), share = covered > 0 ? seen / covered : 1;
        const float hidden = std::min(covered, room(coc_px)) - seen;
        if (share > 0) emit_(share * colour, coc_px, seen, false);
        if (hidden > 0) emit_(hidden / covered * colour, coc_px, hidden, is_hidden(in_front_px_, coc_px));
        open_ -= seen;
        if (covered <= 0) return;
        in_front_px_ = coc_px;
        fronts_[std::size_t(count_++) % fronts_.size()] = {coc_px, covered};
    }

private:
    struct Front {
        float coc_px, covered;
    };

    // Free area of a pixel's lens for a sample of that radius, beside occluders right in front of it.
    float room(float coc_px) const {
        const float close_px = std::max(1.0f, 0.3f * std::abs(coc_px));
        float room = 1;
        for (std::size_t i = 0; i < std::min(std::size_t(count_), fronts_.size()); ++i)
            if (coc_px - fronts_[i].coc_px < close_px) room -= fronts_[i].covered;
        return room;
    }

    const Emit& emit_;
    float open_ = 1, in_front_px_ = -1e30f;
    std::array<Front, 6> fronts_{};  // the last occluders
    int count_ = 0;
};

}  // namespace petzval::engine
