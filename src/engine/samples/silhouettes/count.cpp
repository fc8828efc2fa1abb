#include "engine/samples/silhouettes/count.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/silhouettes/connectivity.h"
#include "image/two_sweeps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

constexpr int kBlock = 8;  // pixels on a side

// The surfaces that a block of pixels hides, coarser than NearSilhouettes finds them.
struct Block {
    float nearest = 1e30f;  // its nearest radius
    float far = -1e30f;     // radius of the farthest surface that a lens may see behind it
    float beyond = 1e9f;    // distance to the silhouette of that surface, less its blur, px
};

// Carries the surfaces at silhouettes into the blocks that lie before them.
void spread(Image<Block>& blocks) {
    two_sweeps(blocks.width(), blocks.height(), [&](int x, int y, int dx, int dy) {
        Block& own = blocks(x, y);
        const Block& other = blocks(x + dx, y + dy);
        const float beyond = other.beyond + float(kBlock) * chamfer_step(dx, dy);
        if (beyond < own.beyond && other.far - own.nearest > completion_model.between_px()) {
            own.beyond = beyond;
            own.far = other.far;
        }
    });
}

}  // namespace

Silhouettes silhouettes_of(View<const float> coc, Workers& workers) {
    const Image<unsigned char> connected = connections(coc, workers);
    Image<Block> blocks((coc.width() + kBlock - 1) / kBlock, (coc.height() + kBlock - 1) / kBlock);
    const auto pixels_of = [&](int x, int y) {
        return Rect{x * kBlock, y * kBlock, (x + 1) * kBlock, (y + 1) * kBlock}.intersected(coc.rect());
    };
    std::vector<Silhouettes> rows(static_cast<std::size_t>(blocks.height()));
    parallel_for(blocks.height(), workers, [&](int by) {
        for (int bx = 0; bx < blocks.width(); ++bx) {
            Block& block = blocks(bx, by);
            const Rect pixels = pixels_of(bx, by);
            for (int y = pixels.y0; y < pixels.y1; ++y)
                for (int x = pixels.x0; x < pixels.x1; ++x) {
                    block.nearest = std::min(block.nearest, coc(x, y));
                    if (connected(x, y) == kAll) continue;
                    rows[std::size_t(by)].at += 1;
                    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                        block.far = std::max(block.far, coc.clamped(x + dx, y + dy));
                }
            if (block.far > -1e30f) block.beyond = -std::abs(block.far);
        }
    });
    spread(blocks);
    parallel_for(blocks.height(), workers, [&](int by) {
        for (int bx = 0; bx < blocks.width(); ++bx) {
            const Block& block = blocks(bx, by);
            const float sharp_px =
                Silhouettes::kSharpPx / std::max(Silhouettes::kSharpPx, std::abs(block.far));
            const Rect pixels = pixels_of(bx, by);
            for (int y = pixels.y0; y < pixels.y1; ++y)
                for (int x = pixels.x0; x < pixels.x1; ++x)
                    if (block.far - coc(x, y) > completion_model.between_px() &&
                        block.beyond <= std::abs(coc(x, y)))
                        rows[std::size_t(by)].hiding += double(sharp_px) * double(sharp_px);
        }
    });
    Silhouettes all;
    for (const Silhouettes& row : rows) {
        all.at += row.at;
        all.hiding += row.hiding;
    }
    const double pixels = double(coc.width()) * double(coc.height());
    return {all.at / pixels, all.hiding / pixels};
}

}  // namespace petzval::engine
