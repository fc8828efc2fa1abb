#include "engine/samples/behind/beside.h"

#include "engine/samples/completion_model.h"
#include "engine/samples/outlines/outline_end.h"

#include <array>

namespace petzval::engine {

std::optional<HiddenGuess> surface_beside(const KnownSurfaces& known, View<const float> coc, int x, int y) {
    constexpr std::array<PixelAt, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    const float own = coc(x, y), least = 0.5f * completion_model.step_px;
    std::optional<HiddenGuess> found;
    float farthest = own + least;
    for (const PixelAt d : kBeside) {
        const int u = x + d.x, v = y + d.y;
        if (!coc.rect().contains(u, v)) continue;
        const float there = coc(u, v);
        if (there <= farthest) continue;
        const float bend = (there - own) - (own - coc.clamped(x - d.x, y - d.y));
        if (bend <= least || !known.shows(u, v, there)) continue;
        farthest = there;
        found = HiddenGuess{{known.colour(u, v), there, 1}, {}, 1, 0};
    }
    return found;
}

}  // namespace petzval::engine
