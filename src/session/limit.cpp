#include "session/limit.h"

#include "engine/samples/all_samples.h"

#include <algorithm>

namespace petzval {
namespace {

// Exact at both ends.
void mix(View<Rgba> blurred, View<const Rgba> sharp, View<const float> mask, Workers& workers) {
    parallel_for(blurred.height(), workers, [&](int y) {
        for (int x = 0; x < blurred.width(); ++x) {
            const float share = mask(x, y) > 0 ? std::min(mask(x, y), 1.0f) : 0.0f;  // NaN is 0
            if (share == 1) continue;
            const Rgba from = engine::finite_colour(sharp(x, y));
            blurred(x, y) = share == 0 ? from : from + share * (blurred(x, y) - from);
        }
    });
}

}  // namespace

void limit_by_mask(DefocusReport& report, const Rendered& rendered, const Rect& pixels, Workers& workers) {
    if (rendered.mask.empty() || !report.panels.empty()) return;
    const View<const float> mask = rendered.mask.part(pixels);
    mix(report.image.view(), rendered.colour.part(pixels), mask, workers);
    for (std::size_t i = 0; i < report.layers.size(); ++i) {
        // A layer has the alpha of the picture.
        Picture sharp = Picture::uninitialised(pixels.width(), pixels.height());
        const View<const Rgba> colour = rendered.layers[i].colour.part(pixels),
                               whole = rendered.colour.part(pixels);
        for (int y = 0; y < sharp.height(); ++y)
            for (int x = 0; x < sharp.width(); ++x)
                sharp(x, y) = {colour(x, y).r, colour(x, y).g, colour(x, y).b, whole(x, y).a};
        mix(report.layers[i].view(), sharp.view(), mask, workers);
    }
}

}  // namespace petzval
