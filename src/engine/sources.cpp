#include "engine/sources.h"

#include "base/parallel.h"
#include "depth/connectivity.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// Position on the scale of levels: 0 up to largest_cells, 1 at twice that.
float level_position(float coc_px, const LevelRule& rule) {
    const float r = std::abs(coc_px);
    return r <= rule.largest_cells ? 0.0f : std::log2(r / rule.largest_cells);
}

// The share of a source of radius coc_px that is spread on level l. Shares of all levels sum to 1.
float share_on_level(float coc_px, int l, const LevelRule& rule) {
    const float at = level_position(coc_px, rule);
    const auto passed = [&](int level) { return std::clamp((at - float(level)) / rule.fade, 0.0f, 1.0f); };
    return (l == 0 ? 1.0f : passed(l - 1)) - passed(l);
}

constexpr float kOpaque = 0.97f;

bool is_emptiness(const CocSample& s) { return s.colour == Rgba{}; }

// The change of weight per pixel away from a source: a facet of a slanted surface is seen larger from one
// side of the pupil than from the other, by 1 + slope . u with u = offset / radius.
depth::Slope tilt_of(depth::Slope slope, float coc_px) {
    constexpr float kLeastRadiusPx = 0.5f;  // narrower discs stay within their pixel
    if (std::abs(coc_px) < kLeastRadiusPx) return {};
    return {slope.x / coc_px, slope.y / coc_px};
}

// The radius of a disc that, averaged over a cell of size x size pixels, is as wide as one of coc_px over a
// pixel: a square of side a adds a^2/12 to the mean square along each axis, a disc of radius r has r^2/4.
float narrowed(float coc_px, int size) {
    const float square = coc_px * coc_px - (float(size * size) - 1) / 3;
    return std::copysign(std::sqrt(std::max(0.0f, square)), coc_px);
}

// Sources of one cell of a coarse level, gathered from its pixels: one per layer.
class Cell {
public:
    void add(int layer, Rgba light, float coc_px, depth::Slope tilt) {
        Sum* sum = nullptr;
        for (Sum& s : sums_)
            if (s.layer == layer) sum = &s;
        if (!sum) sum = &sums_.emplace_back(Sum{layer, {}, 0, 0, 0});
        sum->light += light;
        sum->coc += light.a * coc_px, sum->tilt_x += light.a * tilt.x, sum->tilt_y += light.a * tilt.y;
    }
    void flush(int x, int size, std::vector<Source>& row) {
        for (const Sum& s : sums_) {
            if (s.light.a <= 0) continue;
            const float mean = 1 / s.light.a, cells = 1 / float(size);
            row.push_back({s.light * (cells * cells), narrowed(s.coc * mean, size) * cells,
                           s.tilt_x * mean * float(size), s.tilt_y * mean * float(size), x, s.layer});
        }
        sums_.clear();
    }

private:
    struct Sum {
        int layer;
        Rgba light;
        float coc, tilt_x, tilt_y;
    };
    std::vector<Sum> sums_;
};

class Maker {
public:
    Maker(const CocSamples& samples, View<const float> coc_px, const OpenEdges& open, const LevelRule& rule,
          int threads)
        : samples_(samples),
          coc_px_(coc_px),
          open_(open),
          rule_(rule),
          connected_(depth::connections(coc_px, threads)) {}

    // Calls emit(layer, light, coc_px, tilt) for each sample of pixel (x, y), clamped to the picture.
    template <typename Emit>
    void at(int x, int y, int level, const Emit& emit) const {
        const int width = coc_px_.width(), height = coc_px_.height();
        const int u = std::clamp(x, 0, width - 1), v = std::clamp(y, 0, height - 1);
        // Beyond a closed edge there is emptiness, beyond an open one the outermost pixels are repeated.
        const bool outside = (u != x && !(x < 0 ? open_.left : open_.right)) ||
                             (v != y && !(y < 0 ? open_.top : open_.bottom));
        // What an opaque sample of the same pixel hides comes after it, also where both fall into one
        // interval.
        int least_layer = std::numeric_limits<int>::min();
        for (const CocSample& s : samples_.at(u, v)) {
            const bool empty = outside || is_emptiness(s);
            const int layer = empty ? kEmptyLayer : std::max(least_layer, layer_of(s.coc_px));
            if (s.colour.a > kOpaque && layer < kEmptyLayer) least_layer = layer + 1;
            const float share = share_on_level(s.coc_px, level, rule_);
            if (share <= 0) continue;
            if (empty) {
                emit(kEmptyLayer, Rgba{0, 0, 0, share}, s.coc_px, depth::Slope{});
                if (outside) break;
                continue;
            }
            // Only what is seen has a known slope.
            const bool visible = std::abs(s.coc_px - coc_px_(u, v)) < 0.01f;
            const depth::Slope slope = visible ? depth::slope_at(coc_px_, connected_, u, v) : depth::Slope{};
            emit(layer, share * s.colour, s.coc_px, tilt_of(slope, s.coc_px));
        }
    }

private:
    CocSamplesView samples_;
    View<const float> coc_px_;
    OpenEdges open_;
    LevelRule rule_;
    Image<unsigned char> connected_;
};

}  // namespace

int layer_of(float coc_px) {
    constexpr float kLinearPx = 8, kPerOctave = 8;
    const float r = std::abs(coc_px);
    const int step =
        r < kLinearPx ? int(r + 0.5f) : int(kLinearPx + kPerOctave * std::log2(r / kLinearPx) + 0.5f);
    return coc_px < 0 ? -step : step;
}

float LevelRule::largest_radius() const { return largest_cells * std::exp2(fade); }

std::vector<SourceLevel> make_sources(const CocSamples& samples, View<const float> coc_px,
                                      const OpenEdges& open, const LevelRule& rule, int threads) {
    float largest = 0;
    for (const CocSample& s : samples.samples) largest = std::max(largest, std::abs(s.coc_px));
    const Maker maker(samples, coc_px, open, rule, threads);
    std::vector<SourceLevel> levels(1 + std::size_t(std::ceil(level_position(largest, rule))));
    for (int l = 0; l < int(levels.size()); ++l) {
        SourceLevel& level = levels[std::size_t(l)];
        const int size = 1 << l;
        const int margin = int(std::ceil(rule.largest_radius())) + 3;
        level.area =
            Rect{0, 0, (coc_px.width() + size - 1) / size, (coc_px.height() + size - 1) / size}.grown(margin);
        level.rows.resize(std::size_t(level.area.height()));
        parallel_for(level.area.height(), threads, [&](int i) {
            std::vector<Source>& row = level.rows[std::size_t(i)];
            const int cy = level.area.y0 + i;
            Cell cell;
            for (int cx = level.area.x0; cx < level.area.x1; ++cx) {
                if (l == 0) {
                    maker.at(cx, cy, 0, [&](int layer, Rgba light, float coc, depth::Slope tilt) {
                        row.push_back({light, coc, tilt.x, tilt.y, cx, layer});
                    });
                    continue;
                }
                for (int y = cy * size; y < (cy + 1) * size; ++y)
                    for (int x = cx * size; x < (cx + 1) * size; ++x)
                        maker.at(x, y, l, [&](int layer, Rgba light, float coc, depth::Slope tilt) {
                            cell.add(layer, light, coc, tilt);
                        });
                cell.flush(cx, size, row);
            }
        });
    }
    return levels;
}

}  // namespace petzval::engine
