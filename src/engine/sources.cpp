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

constexpr float kOpaque = 0.97f;

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
        Sum& sum = of_layer(layer);
        sum.light += light;
        sum.coc += light.a * coc_px, sum.tilt_x += light.a * tilt.x, sum.tilt_y += light.a * tilt.y;
    }
    // Appends the sums as sources at cell x of a level with cells of size x size pixels, and starts anew.
    void flush(int x, int size, std::vector<Source>& row) {
        if (first_.light.a > 0) row.push_back(source(first_, x, size));
        for (const Sum& s : more_)
            if (s.light.a > 0) row.push_back(source(s, x, size));
        first_ = {}, more_.clear();
    }

private:
    struct Sum {
        int layer = kNone;
        Rgba light;
        float coc = 0, tilt_x = 0, tilt_y = 0;
    };
    static constexpr int kNone = std::numeric_limits<int>::min();

    Sum& of_layer(int layer) {
        if (first_.layer == layer || first_.layer == kNone) {
            first_.layer = layer;
            return first_;
        }
        for (Sum& s : more_)
            if (s.layer == layer) return s;
        more_.push_back({layer, {}, 0, 0, 0});
        return more_.back();
    }
    static Source source(const Sum& s, int x, int size) {
        const float mean = 1 / s.light.a, cells = 1 / float(size);
        return {s.light * (cells * cells),
                narrowed(s.coc * mean, size) * cells,
                s.tilt_x * mean * float(size),
                s.tilt_y * mean * float(size),
                x,
                s.layer};
    }

    Sum first_;
    std::vector<Sum> more_;
};

// Visits every sample once and hands it to its level, or to two where one fades into the next.
class Maker {
public:
    Maker(const CocSamples& samples, View<const float> coc_px, const LevelRule& rule, int threads)
        : samples_(samples), coc_px_(coc_px), rule_(rule), connected_(depth::connections(coc_px, threads)) {}

    // Pixel (x, y), clamped to the picture; put(level, layer, light, coc_px, tilt).
    template <typename Put>
    void visit(int x, int y, const Put& put) const {
        const int u = std::min(x, coc_px_.width() - 1), v = std::min(y, coc_px_.height() - 1);
        // What an opaque sample of the same pixel hides comes after it, also where both fall into one
        // interval.
        int least_layer = std::numeric_limits<int>::min();
        for (const CocSample& s : samples_.at(u, v)) {
            const int layer = std::max(least_layer, layer_of(s.coc_px));
            if (s.colour.a + s.empty > kOpaque) least_layer = layer + kNextLayer;
            // Only what is seen has a known slope.
            const bool visible = std::abs(s.coc_px - coc_px_(u, v)) < 0.01f;
            const depth::Slope slope = visible ? depth::slope_at(coc_px_, connected_, u, v) : depth::Slope{};
            const depth::Slope tilt = tilt_of(slope, s.coc_px);
            const float at = level_position(s.coc_px, rule_);
            const int level = int(std::ceil(at));
            const float share = level == 0 ? 1.0f : std::min(1.0f, (at - float(level - 1)) / rule_.fade);
            const auto put_both = [&](int in_layer, Rgba light) {
                put(level, in_layer, share * light, s.coc_px, tilt);
                if (share < 1) put(level - 1, in_layer, (1 - share) * light, s.coc_px, tilt);
            };
            if (s.colour.a > 0) put_both(layer, s.colour);
            if (s.empty > 0)
                put_both(is_behind_everything(s) ? kEmptyLayer : layer + kEmptinessAfter, {0, 0, 0, s.empty});
        }
    }

private:
    CocSamplesView samples_;
    View<const float> coc_px_;
    LevelRule rule_;
    Image<unsigned char> connected_;
};

// Beyond an open edge the outermost cells are repeated, beyond a closed one there is emptiness.
void add_margins(SourceLevel& level, int margin, const OpenEdges& open, int threads) {
    const int width = level.area.width() - 2 * margin, height = level.area.height() - 2 * margin;
    const auto copy_of = [](Source s, int x, bool is_open) {
        s.x = x;
        if (!is_open) s.light = {0, 0, 0, s.light.a}, s.layer = kEmptyLayer, s.tilt_x = s.tilt_y = 0;
        return s;
    };
    parallel_for(height, threads, [&](int y) {
        std::vector<Source>& row = level.rows[std::size_t(y + margin)];
        std::vector<Source> whole;
        whole.reserve(row.size() + 4 * std::size_t(margin));
        const auto repeat = [&](int from_x, int x0, int x1, bool is_open) {
            for (int x = x0; x < x1; ++x)
                for (const Source& s : row)
                    if (s.x == from_x) whole.push_back(copy_of(s, x, is_open));
        };
        // Only the few sources at the ends are looked at: rows ascend in x.
        const std::vector<Source> all = std::move(row);
        std::size_t head = 0, tail = all.size();
        while (head < all.size() && all[head].x == 0) ++head;
        while (tail > 0 && all[tail - 1].x == width - 1) --tail;
        row.assign(all.begin(), all.begin() + std::ptrdiff_t(head));
        repeat(0, -margin, 0, open.left);
        whole.insert(whole.end(), all.begin(), all.end());
        row.assign(all.begin() + std::ptrdiff_t(tail), all.end());
        repeat(width - 1, width, width + margin, open.right);
        row = std::move(whole);
    });
    for (int k = 0; k < margin; ++k) {
        const auto& top = level.rows[std::size_t(margin)];
        const auto& bottom = level.rows[std::size_t(margin + height - 1)];
        for (const Source& s : top) level.rows[std::size_t(k)].push_back(copy_of(s, s.x, open.top));
        for (const Source& s : bottom)
            level.rows[std::size_t(margin + height + k)].push_back(copy_of(s, s.x, open.bottom));
    }
}

}  // namespace

int layer_of(float coc_px) {
    constexpr float kLinearPx = 8, kPerOctave = 8;
    const float r = std::abs(coc_px);
    const int step =
        r < kLinearPx ? int(r + 0.5f) : int(kLinearPx + kPerOctave * std::log2(r / kLinearPx) + 0.5f);
    return kNextLayer * (coc_px < 0 ? -step : step);
}

float radius_in_pixels(float radius, int level) {
    const float size = float(1 << level), square = radius * radius * size * size;
    return level == 0 ? radius
                      : std::copysign(std::sqrt(square + (size * size - 1) / 3), radius);  // narrowed()
}

float LevelRule::largest_radius() const { return largest_cells * std::exp2(fade); }

std::vector<SourceLevel> make_sources(const CocSamples& samples, View<const float> coc_px,
                                      const OpenEdges& open, const LevelRule& rule, int threads) {
    float largest = 0;
    for (const CocSample& s : samples.samples) largest = std::max(largest, std::abs(s.coc_px));
    const Maker maker(samples, coc_px, rule, threads);
    const int coarsest = int(std::ceil(level_position(largest, rule)));
    const int margin = int(std::ceil(rule.largest_radius())) + 3;
    const auto cells = [](int pixels, int level) { return ((pixels - 1) >> level) + 1; };
    std::vector<SourceLevel> levels(std::size_t(coarsest) + 1);
    for (int l = 0; l <= coarsest; ++l) {
        levels[std::size_t(l)].area =
            Rect{0, 0, cells(coc_px.width(), l), cells(coc_px.height(), l)}.grown(margin);
        levels[std::size_t(l)].rows.resize(std::size_t(levels[std::size_t(l)].area.height()));
    }
    // A band of rows as tall as the largest cell is done by one thread.
    const int band_height = 1 << coarsest;
    parallel_for(cells(coc_px.height(), coarsest), threads, [&](int band) {
        std::vector<std::vector<Cell>> row_cells(
            levels.size());  // of the row of cells under way, per coarse level
        for (int l = 1; l <= coarsest; ++l)
            row_cells[std::size_t(l)].resize(std::size_t(cells(coc_px.width(), l)));
        for (int y = band * band_height; y < (band + 1) * band_height; ++y) {
            for (int x = 0; x < cells(coc_px.width(), coarsest) << coarsest; ++x)
                maker.visit(x, y, [&](int l, int layer, Rgba light, float coc, depth::Slope tilt) {
                    if (l > 0) {
                        if (std::size_t(x >> l) < row_cells[std::size_t(l)].size())
                            row_cells[std::size_t(l)][std::size_t(x >> l)].add(layer, light, coc, tilt);
                    } else if (x < coc_px.width() && y < coc_px.height()) {
                        levels[0].rows[std::size_t(y + margin)].push_back(
                            {light, coc, tilt.x, tilt.y, x, layer});
                    }
                });
            for (int l = 1; l <= coarsest; ++l) {
                const int row = y >> l;
                if ((y + 1) % (1 << l) != 0 || row >= cells(coc_px.height(), l)) continue;
                std::vector<Source>& sources = levels[std::size_t(l)].rows[std::size_t(row + margin)];
                for (std::size_t x = 0; x < row_cells[std::size_t(l)].size(); ++x)
                    row_cells[std::size_t(l)][x].flush(int(x), 1 << l, sources);
            }
        }
    });
    for (SourceLevel& level : levels) add_margins(level, margin, open, threads);
    return levels;
}

}  // namespace petzval::engine
