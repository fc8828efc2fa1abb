#include "engine/samples/deep/lens_area.h"

#include "base/parallel.h"
#include "engine/samples/layers.h"
#include "engine/samples/lens_left.h"

#include <algorithm>
#include <limits>

namespace petzval::engine {

void share_lens_area(CocSamples& samples, Workers& workers) {
    parallel_for(samples.height(), workers, [&](int y) {
        const std::size_t row = std::size_t(y) * std::size_t(samples.width);
        for (std::size_t i = row; i < row + std::size_t(samples.width); ++i) {
            float open = 1;
            LensLeft left;
            LayersOfPixel layers(true);
            bool dimmed_in_layer = false, full_in_layer = false;
            int layer = std::numeric_limits<int>::min();
            for (std::size_t k = samples.first[i]; k < samples.first[i + 1]; ++k) {
                CocSample& s = samples.samples[k];
                if (const int own = layers.at(s.coc_px); own != layer) {
                    layer = own;
                    dimmed_in_layer = full_in_layer = false;
                }
                const float alpha = s.colour.a;
                const bool opaque = alpha > 1 - 1e-3f;
                // The room that other surfaces leave is found where they are composited.
                left.meet(layer);
                if (!opaque || dimmed_in_layer)
                    s.colour *= full_in_layer || open <= 0 ? 0 : std::min(1.0f, open / left.before);
                // The coverage of a dimmed sample no longer shows that it hides the samples behind it.
                if (opaque && dimmed_in_layer) full_in_layer = true;
                if (!opaque) left.take(s.colour.a, layer), open *= 1 - alpha, dimmed_in_layer = true;
                layers.next(s);
            }
        }
    });
}

}  // namespace petzval::engine
