// What a near thing hides just inside its edge, guessed per block of pixels: enough for the soft edge of a
// preview. (engine/samples/hidden.h does it per pixel, for final frames.)
#pragma once

#include "engine/waist/engine.h"

#include <optional>

namespace petzval::engine {

class BlockFill {
public:
    // Nothing is hidden anywhere.
    BlockFill() = default;
    // Looks from every block that holds something in front of focus, in 16 directions as far as its blur
    // reaches, for farther surfaces around; the one met most, by 1/distance^2, goes on behind.
    static BlockFill make(const Input& input);
    // Pixels a side of its blocks (a power of two), and how far what decides a fill may lie from it.
    static int block_px(float nearest_coc_px);
    static int reach_px(float nearest_coc_px);

    // The sample behind the visible one, covering its pixel, blended from the blocks around; none if nothing
    // is farther by a pixel of radius.
    std::optional<CocSample> behind(int x, int y, float coc_px) const {
        if (fills_.empty() || coc_px > -1) return std::nullopt;
        return blended(x, y, coc_px);
    }

private:
    std::optional<CocSample> blended(int x, int y, float coc_px) const;

    struct Fill {
        CocSample sample;
        bool found;
    };
    int block_ = 4;
    Image<Fill> fills_;
};

}  // namespace petzval::engine
