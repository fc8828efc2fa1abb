#include "engine/gather/gather_cells.h"

#include "base/parallel.h"

#include <algorithm>

namespace petzval::engine {
namespace {

CellLight& of_ring(std::vector<CellLight>& lights, std::size_t begin, int ring) {
    for (std::size_t i = begin; i < lights.size(); ++i)
        if (lights[i].ring == ring) return lights[i];
    lights.push_back({});
    lights.back().ring = ring;
    return lights.back();
}

}  // namespace

CellLevel::CellLevel(const Input& input, const BlockFill& fill, const RingSizes& sizes, int level)
    : width_((input.width() + (1 << level) - 1) >> level),
      height_((input.height() + (1 << level) - 1) >> level),
      rows_(std::size_t(height_)) {
    const int size = 1 << level;
    const float per_pixel = 1 / float(size * size);
    parallel_for(height_, *input.workers, [&](int cy) {
        Row& row = rows_[std::size_t(cy)];
        row.first.reserve(std::size_t(width_) + 1);
        for (int cx = 0; cx < width_; ++cx) {
            const std::size_t begin = row.lights.size();
            row.first.push_back(begin);
            for (int y = cy * size; y < (cy + 1) * size; ++y)
                for (int x = cx * size; x < (cx + 1) * size; ++x) {
                    const int u = std::min(x, input.width() - 1), v = std::min(y, input.height() - 1);
                    const bool outside_x = u != x, outside_y = v != y;
                    const bool open =
                        (!outside_x || input.open_edges.right) && (!outside_y || input.open_edges.bottom);
                    const auto add = [&](int ring, float share, Rgba colour, float covered) {
                        if (share <= 0 || sizes.level(ring) != level) return;
                        CellLight& light = of_ring(row.lights, begin, ring);
                        const float weight = share * per_pixel;
                        if (!outside_x && !outside_y) light.colour += weight * colour;
                        (outside_x || outside_y)&& open ? light.beyond += weight* covered
                                                        : light.covered += weight * covered;
                    };
                    for_each_sample(input, fill, u, v, [&](Rgba colour, float coc_px, float covered) {
                        const RingSizes::Mix mix = sizes.mix(coc_px);
                        add(mix.inner, 1 - mix.outer_share, colour, covered);
                        add(mix.outer, mix.outer_share, colour, covered);
                    });
                }
        }
        row.first.push_back(row.lights.size());
    });
}

}  // namespace petzval::engine
