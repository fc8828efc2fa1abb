// Finds the pixels so near to a silhouette that a lens looks past it, at a surface behind them.
#pragma once

#include "petzval/workers.h"

#include "engine/samples/hidden.h"

#include <array>

namespace petzval::engine {

// Answers for blocks of pixels, and never misses one: searches that find nothing are only slower.
class NearSilhouettes {
public:
    NearSilhouettes(View<const float> coc_px, const Mixtures& mixtures, Workers& workers);

    // False if no ray past an edge of the surface at (x, y), of radius own_px, meets another one behind it.
    bool may_hide(int x, int y, float own_px) const {
        const float reach_px = kNextPx - own_px;
        const Block& b = blocks_(x / kBlock, y / kBlock);
        return b[0].beyond_px <= reach_px || b[1].beyond_px <= reach_px;
    }

    // The mixed pixel of an edge and the next: blur of 1 px still mixes light there.
    static constexpr float kNextPx = 2;

private:
    static constexpr int kBlock = 2;  // side of a block in pixels
    // A surface behind a silhouette: its radius, and its distance from a block less that radius.
    struct Behind {
        float beyond_px = 1e9f, coc_px = -1e30f;
    };
    // The surface that comes closest by that, and the farthest one: pixels that lie behind the first may
    // hide the second.
    using Block = std::array<Behind, 2>;
    static void add(Block& block, const Behind& behind);
    void spread(const Plane& nearest);

    Image<Block> blocks_;
};

}  // namespace petzval::engine
