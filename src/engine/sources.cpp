#include "engine/sources.h"

#include "base/parallel.h"
#include "depth/connectivity.h"
#include "depth/hidden.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr float kLeastShare = 1e-3f;
// Across this share of a switch between levels a source is spread on both, fading from one to the other.
constexpr float kFade = 0.15f;

// A source before it is put on a level.
struct Emitter {
    Rgba light;
    float coc_px = 0;
    depth::Slope slope;
};

// What every pixel of the picture emits: its visible surface or the two of a silhouette, and what is hidden behind.
class Emitters {
public:
    Emitters(const Input& input, View<const Rgba> base)
        : input_(input), base_(base), connected_(depth::connections(input.coc_px, input.threads)) {
        if (!input.deep.empty()) return;
        mixtures_ = depth::unmix_silhouettes(base, input.coc_px, connected_, input.threads);
        hidden_ = depth::fill_hidden(base, input.coc_px, connected_, mixtures_, input.threads);
    }

    // Calls emit(Emitter) for each of pixel (x, y).
    template <typename Emit>
    void at(int x, int y, const Emit& emit) const {
        const depth::Slope slope = depth::slope_at(input_.coc_px, connected_, x, y);
        if (!input_.deep.empty()) {
            const std::size_t pixel = std::size_t(y) * std::size_t(input_.width()) + std::size_t(x);
            for (const CocSample& s : input_.deep.at(pixel)) emit(Emitter{s.colour, s.coc_px, slope});
            return;
        }
        if (const depth::Mixture* m = mixtures_.at(x, y)) {
            if (m->near_share > kLeastShare) {
                Rgba near = m->near_colour;
                near.a = m->near_share;
                emit(Emitter{near, m->near_coc_px, {}});
            }
            Rgba far = m->far_colour;
            far.a = 1;
            emit(Emitter{far, m->far_coc_px, {}});
            return;
        }
        Rgba light = base_(x, y);
        light.a = 1;
        emit(Emitter{light, input_.coc_px(x, y), slope});
        if (const depth::Hidden* h = hidden_.at(x, y)) {
            Rgba behind = h->colour;
            behind.a = 1;
            emit(Emitter{behind, h->coc_px, {}});
        }
    }

private:
    const Input& input_;
    View<const Rgba> base_;
    Image<unsigned char> connected_;
    depth::Sparse<depth::Mixture> mixtures_;
    depth::Sparse<depth::Hidden> hidden_;
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
    const int step = r < kLinearPx ? int(r + 0.5f) : int(kLinearPx + kPerOctave * std::log2(r / kLinearPx) + 0.5f);
    return coc_px < 0 ? -step : step;
}

SourceGrid SourceGrid::make(const Input& input, View<const Rgba> base, float largest_cells) {
    const Emitters emitters(input, base);
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
                        const int u = std::clamp(x, 0, input.width() - 1), v = std::clamp(y, 0, input.height() - 1);
                        if ((u != x && !(x < 0 ? open.left : open.right)) || (v != y && !(y < 0 ? open.top : open.bottom)))
                            continue;
                        emitters.at(u, v, [&](const Emitter& e) {
                            // Level n takes what lies in (n - 1, n], and fades into n + 1 at its upper end.
                            const float at = level_of(e.coc_px, largest_cells);
                            const float below = std::clamp((at - float(l - 1)) / kFade, 0.0f, 1.0f);
                            const float above = std::clamp((at - float(l)) / kFade, 0.0f, 1.0f);
                            const float share = (l == 0 ? 1.0f : below) - above;
                            if (share > 0) cell.add(e, share);
                        });
                    }
                cell.flush(cx, size * size, row);
            }
        });
        grid.levels_.push_back(std::move(level));
    }
    return grid;
}

}  // namespace petzval::engine
