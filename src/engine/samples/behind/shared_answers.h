// Answers that the pixels of one square share.
#pragma once

#include "engine/samples/behind/smooth.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace petzval::engine {

constexpr int kLargestSquare = HiddenLayers::kBand;

// Hidden surfaces are seen through their own blur and, except their textures, as means (behind/smooth.h; not
// in previews), so pixels of one surface share the answer of the first pixel in a square. Returns the side of
// that square, pixels. A hidden outline outline_px away does not cross it.
inline int shared_square(std::span<const HiddenGuess> hidden, const FillRule& rule, float outline_px) {
    float least_blur = 1e30f, least_mean_px = 1e30f;
    for (const HiddenGuess& g : hidden) {
        least_blur = std::min(least_blur, std::abs(g.seen.coc_px) / rule.shared_from_px);
        least_mean_px = std::min(least_mean_px, rule.smooths && g.plain == 1 ? g.smooth_px : 0);
    }
    int side = 1;
    if (least_blur >= 6)
        side = kLargestSquare;
    else if (least_blur >= 2 || least_mean_px >= 6)
        side = 4;
    else if (least_blur >= 1 || least_mean_px >= 2)
        side = 2;
    while (side > 1 && float(side - 1) > outline_px) side /= 2;
    return side;
}

// The answers that were found so far in one square of kLargestSquare pixels.
class SharedAnswers {
public:
    void clear() { answers_.clear(); }
    const HiddenLayers::Range* find(int x, int y, float surface_px) const {
        for (const Answer& a : answers_)
            if (((x ^ a.x) | (y ^ a.y)) < a.square &&  // squares are powers of two
                std::abs(a.surface_px - surface_px) <= completion_model.step_px / 2)
                return &a.range;
        return nullptr;
    }
    void add(int x, int y, float surface_px, int square, HiddenLayers::Range range) {
        answers_.push_back({x, y, square, surface_px, range});
    }

private:
    struct Answer {
        int x, y, square;
        float surface_px;
        HiddenLayers::Range range;
    };
    std::vector<Answer> answers_;
};

}  // namespace petzval::engine
