// Means of a picture's surfaces in focus.
#pragma once

#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"

#include <cmath>
#include <functional>

namespace petzval::engine {

// True if the pixel shows a surface sharp enough for its texture to be seen.
inline bool shows_sharp(const KnownSurfaces& known, int x, int y) {
    return std::abs(known.radii()(x, y)) < completion_model.texture_sharp_px;
}

class SharpMeans {
public:
    static constexpr int kBlock = 8;  // side of a block in pixels; it has one mean

    SharpMeans() = default;
    // needed: of a block; the others have no mean.
    SharpMeans(const KnownSurfaces& known, const std::function<bool(const Rect&)>& needed, Workers& workers);

    bool known_at(int x, int y) const { return means_(x / kBlock, y / kBlock).count > 0; }
    // Mean light around the middle of a pixel that shows a sharp surface; light above white counts as white.
    Rgba at(float x, float y) const;

private:
    // The sum of the sharp pixels of a block, or of some blocks.
    struct Sum {
        Rgba light;
        float count = 0;
        void add(const Sum& other, float weight) {
            light += weight * other.light, count += weight * other.count;
        }
    };
    Image<Sum> means_;  // of 3 x 3 blocks
};

}  // namespace petzval::engine
