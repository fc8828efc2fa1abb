#include "engine/sources.h"

#include "base/parallel.h"
#include "depth/connectivity.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// Across this share of a switch between levels a source is spread on both, fading from one to the other.
constexpr float kFade = 0.15f;

// A source before it is put on a level.
struct Emitter {
    Rgba light;
    float coc_px = 0;
    depth::Slope slope;
};

// The level whose cells see the radius as at most largest_cells, as a real number: 0 below it, 1 at twice it.
float level_of(float coc_px, float largest_cells) {
    const float r = std::abs(coc_px);
    return r <= largest_cells ? 0.0f : std::log2(r / largest_cells);
}

// Sources of one cell of a coarse level, gathered from its pixels: one per layer.
class Cell {
public:
    void add(const Emitter& e, float share) {
        const int layer = layer_of(e.coc_px);
        Sum* sum = nullptr;
        for (Sum& s : sums_)
            if (s.layer == layer) sum = &s;
        if (!sum) sum = &sums_.emplace_back(Sum{layer, {}, 0, 0, 0});
        sum->light += share * e.light;
        const float weight = share * e.light.a;
        sum->coc += weight * e.coc_px, sum->slope_x += weight * e.slope.x, sum->slope_y += weight * e.slope.y;
    }
    void flush(int x, int pixels, std::vector<Source>& row) {
        for (const Sum& s : sums_) {
            if (s.light.a <= 0) continue;
            const float per_weight = 1 / s.light.a;
            row.push_back({s.light * (1 / float(pixels)), s.coc * per_weight, s.slope_x * per_weight,
                           s.slope_y * per_weight, x, s.layer});
        }
        sums_.clear();
    }

private:
    struct Sum {
        int layer;
        Rgba light;
        float coc, slope_x, slope_y;
    };
    std::vector<Sum> sums_;
};

}  // namespace

int layer_of(float coc_px) {
    constexpr float kLinearPx = 8, kPerOctave = 6;
    const float r = std::abs(coc_px);
    const int step =
        r < kLinearPx ? int(r + 0.5f) : int(kLinearPx + kPerOctave * std::log2(r / kLinearPx) + 0.5f);
    return coc_px < 0 ? -step : step;
}

SourceGrid SourceGrid::make(const Input& input, float largest_cells) {
    const Image<unsigned char> connected = depth::connections(input.coc_px, input.threads);
    float largest = 0;
    for (int y = 0; y < input.height(); ++y)
        for (int x = 0; x < input.width(); ++x) largest = std::max(largest, std::abs(input.coc_px(x, y)));
    for (const CocSample& s : input.deep.samples) largest = std::max(largest, std::abs(s.coc_px));

    SourceGrid grid;
    const int levels = 1 + int(std::ceil(level_of(largest, largest_cells)));
    for (int l = 0; l < levels; ++l) {
        const int size = 1 << l;
        const int margin = int(std::ceil(largest_cells * (1 + kFade))) + 2;
        const OpenEdges& open = input.open_edges;
        Level level;
        level.area = {open.left ? -margin : 0, open.top ? -margin : 0,
                      (input.width() + size - 1) / size + (open.right ? margin : 0),
                      (input.height() + size - 1) / size + (open.bottom ? margin : 0)};
        level.rows.resize(std::size_t(level.area.height()));
        parallel_for(level.area.height(), input.threads, [&](int i) {
            std::vector<Source>& row = level.rows[std::size_t(i)];
            const int cy = level.area.y0 + i;
            Cell cell;
            for (int cx = level.area.x0; cx < level.area.x1; ++cx) {
                for (int y = cy * size; y < (cy + 1) * size; ++y)
                    for (int x = cx * size; x < (cx + 1) * size; ++x) {
                        // Beyond an open edge the outermost pixels are repeated.
                        const int u = std::clamp(x, 0, input.width() - 1),
                                  v = std::clamp(y, 0, input.height() - 1);
                        if ((u != x && !(x < 0 ? open.left : open.right)) ||
                            (v != y && !(y < 0 ? open.top : open.bottom)))
                            continue;
                        const depth::Slope slope = depth::slope_at(input.coc_px, connected, u, v);
                        for (const CocSample& sample :
                             input.deep.at(std::size_t(v) * std::size_t(input.width()) + std::size_t(u))) {
                            // Only what is seen has a known slope.
                            const bool visible = std::abs(sample.coc_px - input.coc_px(u, v)) < 0.01f;
                            const Emitter e{sample.colour, sample.coc_px, visible ? slope : depth::Slope{}};
                            // Level n takes what lies in (n - 1, n], and fades into n + 1 at its upper end.
                            const float at = level_of(e.coc_px, largest_cells);
                            const float below = std::clamp((at - float(l - 1)) / kFade, 0.0f, 1.0f);
                            const float above = std::clamp((at - float(l)) / kFade, 0.0f, 1.0f);
                            const float share = (l == 0 ? 1.0f : below) - above;
                            if (share > 0) cell.add(e, share);
                        }
                    }
                cell.flush(cx, size * size, row);
            }
        });
        grid.levels_.push_back(std::move(level));
    }
    return grid;
}

}  // namespace petzval::engine
