// Kernels as the page is given them: weights of their lit part.
#pragma once

#include "device/laid_out.h"
#include "device/webgl/handed_over.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace petzval::device::webgl {

struct LitKernel {
    std::shared_ptr<const kernel::PointSpread> spread;
    Rect lit;  // of its weights
    std::size_t bytes = 0;

    static std::shared_ptr<const LitKernel> laid_out(const KernelSource::Made& spreads) {
        const auto& spread = spreads.front();
        const Rect lit = lit_part(spread->weights);
        return std::make_shared<const LitKernel>(
            LitKernel{spread, lit, sizeof(Rgba) * std::size_t(lit.width()) * std::size_t(lit.height())});
    }
};

class PageAtlas final : public Atlas {
public:
    explicit PageAtlas(std::vector<std::shared_ptr<const LitKernel>> kernels)
        : kernels_(std::move(kernels)) {}

    std::size_t size() const { return kernels_.size(); }
    // Records: the first weight, the corner, width and height, all of a kernel. Weights: r, g, b, a, row by
    // row.
    void hand_over(const char* records_name, const char* weights_name) const {
        Words records, weights;
        for (const auto& kernel : kernels_) {
            const Rect &lit = kernel->lit, &whole = kernel->spread->extent;
            records.add_all(weights.count() / 4, whole.x0 + lit.x0, whole.y0 + lit.y0, lit.width(),
                            lit.height());
            for (int y = lit.y0; y < lit.y1; ++y)
                for (int x = lit.x0; x < lit.x1; ++x) {
                    const Rgba w = kernel->spread->weights(x, y);
                    weights.add_all(w.r, w.g, w.b, w.a);
                }
        }
        records.hand_over(records_name);
        weights.hand_over(weights_name);
    }

private:
    std::vector<std::shared_ptr<const LitKernel>> kernels_;  // in the order of the set
};

}  // namespace petzval::device::webgl
