#include "engine/samples/behind/near_silhouettes.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "image/two_sweeps.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {

NearSilhouettes::NearSilhouettes(View<const float> coc, const Mixtures& mixtures, Workers& workers) {
    const int width = (coc.width() + kBlock - 1) / kBlock, height = (coc.height() + kBlock - 1) / kBlock;
    blocks_ = Image<Block>(width, height);
    Plane nearest(width, height, 1e30f);
    parallel_for(height, workers, [&](int by) {
        for (int y = by * kBlock; y < std::min((by + 1) * kBlock, coc.height()); ++y) {
            for (int x = 0; x < coc.width(); ++x)
                nearest(x / kBlock, by) = std::min(nearest(x / kBlock, by), coc(x, y));
            // (Two pixels of two blocks may be closer than the blocks by the length of a block's diagonal
            // and a half.)
            mixtures.for_each_in_row(y, [&](int x, const Mixture& m) {
                add(blocks_(x / kBlock, by), {-m.far_coc_px - 2 * kBlock, m.far_coc_px});
            });
        }
    });
    spread(nearest);
}

void NearSilhouettes::add(Block& block, const Behind& behind) {
    if (behind.beyond_px < block[0].beyond_px) block[0] = behind;
    if (behind.coc_px > block[1].coc_px ||
        (behind.coc_px == block[1].coc_px && behind.beyond_px < block[1].beyond_px))
        block[1] = behind;
}

// A surface does not enter blocks that lie as far as itself.
void NearSilhouettes::spread(const Plane& nearest) {
    two_sweeps(blocks_.width(), blocks_.height(), [&](int x, int y, int dx, int dy) {
        for (const Behind& b : blocks_(x + dx, y + dy))
            if (b.coc_px > nearest(x, y) + completion_model.between_px())
                add(blocks_(x, y), {b.beyond_px + chamfer_step(dx, dy) * kBlock, b.coc_px});
    });
}

}  // namespace petzval::engine
