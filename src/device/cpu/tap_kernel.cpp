#include "device/cpu/tap_kernel.h"

#include "base/cancel.h"
#include "device/cpu/gather_taps.h"

#include <array>

namespace petzval::device {

std::shared_ptr<const TapKernel> TapKernel::laid_out(const KernelSource::Made& spreads) {
    using engine::kGatherRows;
    const kernel::PointSpread& spread = *spreads.front();
    auto made = std::make_shared<TapKernel>();
    made->neutral = spread.neutral;
    made->extent = spread.extent;
    const Rect& e = spread.extent;
    for (int dy = 1 - e.y1; dy < kGatherRows - e.y0; ++dy) {
        check_cancelled();
        for (int dx = 1 - e.x1; dx <= -e.x0; ++dx) {
            std::array<Rgba, kGatherRows> rows;  // of output: each lies its number further from what is read
            for (int k = 0; k < kGatherRows; ++k)
                if (const int v = k - dy - e.y0; v >= 0 && v < e.height())
                    rows[std::size_t(k)] = spread.weights(-dx - e.x0, v);
            if (rows == std::array<Rgba, kGatherRows>{}) continue;
            made->steps.push_back({dx, dy});
            for (const Rgba& w : rows)
                if (spread.neutral)
                    made->weights.push_back(w.r);
                else
                    made->weights.insert(made->weights.end(), {w.r, w.g, w.b, w.a});
        }
    }
    made->bytes = sizeof(*made) + made->steps.size() * sizeof(Step) + made->weights.size() * sizeof(float);
    return made;
}

}  // namespace petzval::device
