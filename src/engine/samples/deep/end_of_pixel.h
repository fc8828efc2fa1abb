// A deep pixel may end at its first opaque sample, and may be as one of a flat picture.
#pragma once

#include "engine/waist/coc_samples.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <span>

namespace petzval::engine {

// The samples of a deep pixel, nearest first and dimming each other: whether they continue behind an opaque
// one.
class EndOfDeepPixel {
public:
    explicit EndOfDeepPixel(std::span<const CocSample> samples) {
        float open = 1;
        for (const CocSample& s : samples) {
            continues_ = continues_ || open <= 1 - laws::kOpaque;
            open *= 1 - s.colour.a;
            last_px_ = s.coc_px;
        }
        is_opaque_ = open <= 1 - laws::kOpaque;
    }
    // True if an opaque sample ends the pixel, and hides a surface of this radius.
    bool is_before(float coc_px) const {
        return is_opaque_ && !continues_ && laws::is_in_front(last_px_, coc_px, laws::kConnected.step_px);
    }

private:
    float last_px_ = 0;
    bool is_opaque_ = false, continues_ = false;  // behind an opaque sample
};

// True if pixel (x, y) is one of a flat picture: it has one opaque sample, and the pixels around have no more
// than one, so the file does not separate silhouettes here.
inline bool is_flat_pixel(const CocSamplesView& deep, int x, int y) {
    if (deep.at(x, y).size() != 1 || deep.at(x, y).front().colour.a < laws::kOpaque) return false;
    for (int v = std::max(0, y - 1); v <= std::min(deep.height() - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(deep.width() - 1, x + 1); ++u)
            if (deep.at(u, v).size() > 1) return false;
    return true;
}

}  // namespace petzval::engine
