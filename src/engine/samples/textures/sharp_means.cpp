#include "engine/samples/textures/sharp_means.h"

#include "base/parallel.h"

#include <algorithm>

namespace petzval::engine {

SharpMeans::SharpMeans(const KnownSurfaces& known, const std::function<bool(const Rect&)>& needed,
                       Workers& workers) {
    const Rect all = known.radii().rect();
    Image<Sum> own((all.width() + kBlock - 1) / kBlock, (all.height() + kBlock - 1) / kBlock);
    parallel_for(own.height(), workers, [&](int v) {
        for (int u = 0; u < own.width(); ++u) {
            const Rect block =
                Rect{u * kBlock, v * kBlock, (u + 1) * kBlock, (v + 1) * kBlock}.intersected(all);
            if (!needed(block)) continue;
            for (int y = block.y0; y < block.y1; ++y)
                for (int x = block.x0; x < block.x1; ++x)
                    if (shows_sharp(known, x, y)) own(u, v).add({known.dim_colour(x, y), 1}, 1);
        }
    });
    means_ = Image<Sum>(own.width(), own.height());
    parallel_for(own.height(), workers, [&](int v) {
        for (int u = 0; u < own.width(); ++u)
            for (int y = std::max(0, v - 1); y <= std::min(own.height() - 1, v + 1); ++y)
                for (int x = std::max(0, u - 1); x <= std::min(own.width() - 1, u + 1); ++x)
                    means_(u, v).add(own(x, y), (x == u ? 2.0f : 1.0f) * (y == v ? 2.0f : 1.0f));
    });
}

Rgba SharpMeans::at(float x, float y) const {
    const float u = std::clamp((x + 0.5f) / kBlock - 0.5f, 0.0f, float(means_.width() - 1));
    const float v = std::clamp((y + 0.5f) / kBlock - 0.5f, 0.0f, float(means_.height() - 1));
    const int u0 = int(u), v0 = int(v);
    const int u1 = std::min(u0 + 1, means_.width() - 1), v1 = std::min(v0 + 1, means_.height() - 1);
    const float right = u - float(u0), down = v - float(v0);
    Sum sum;
    sum.add(means_(u0, v0), (1 - right) * (1 - down)), sum.add(means_(u1, v0), right * (1 - down));
    sum.add(means_(u0, v1), (1 - right) * down), sum.add(means_(u1, v1), right * down);
    return sum.light * (1 / sum.count);
}

}  // namespace petzval::engine
