#include "kernel/model/pieces.h"

namespace petzval::kernel {

Rgba sum_of(const PointSpread& spread) {
    Rgba sum;
    for (std::size_t i = 0; i < spread.weights.size(); ++i) sum += spread.weights.pixels()[i];
    return sum;
}

void scale(PointSpread& spread, Rgba by) {
    for (std::size_t i = 0; i < spread.weights.size(); ++i) {
        Rgba& w = spread.weights.pixels()[i];
        w = {w.r * by.r, w.g * by.g, w.b * by.b, w.a * by.a};
    }
}

void scale_to_rest(PointSpread& skirt, Rgba in_core) {
    const auto factor = [](float has, float asked) {
        return has > 0 ? std::max(0.0f, 1 - asked) / has : 0.0f;
    };
    const Rgba sum = sum_of(skirt);
    scale(skirt, {factor(sum.r, in_core.r), factor(sum.g, in_core.g), factor(sum.b, in_core.b),
                  factor(sum.a, in_core.a)});
}

}  // namespace petzval::kernel
