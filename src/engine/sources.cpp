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
    Maker(const CocSamples& samples, View<const float> coc_px, View<const unsigned char> connected,
          const LevelRule& rule)
        : samples_(samples), coc_px_(coc_px), connected_(connected), rule_(rule) {}

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
    View<const unsigned char> connected_;
    LevelRule rule_;
};

// A source of an outermost cell, repeated at cell x beyond an edge: beyond an open one the picture goes on,
// beyond a closed one there is emptiness.
Source beyond_edge(Source s, int x, bool open) {
    s.x = x;
    if (!open) s.light = {0, 0, 0, s.light.a}, s.layer = kEmptyLayer, s.tilt_x = s.tilt_y = 0;
    return s;
}

// A row of cells 0…width-1 with `margin` more at either end.
std::vector<Source> with_margins(std::span<const Source> row, int width, int margin, const OpenEdges& open) {
    std::size_t head = 0, tail = 0;  // sources in the first and the last cell: rows ascend in x
    while (head < row.size() && row[head].x == 0) ++head;
    while (tail < row.size() && row[row.size() - 1 - tail].x == width - 1) ++tail;
    std::vector<Source> whole;
    whole.reserve(row.size() + std::size_t(margin) * (head + tail));
    for (int x = -margin; x < 0; ++x)
        for (const Source& s : row.first(head)) whole.push_back(beyond_edge(s, x, open.left));
    whole.insert(whole.end(), row.begin(), row.end());
    for (int x = width; x < width + margin; ++x)
        for (const Source& s : row.last(tail)) whole.push_back(beyond_edge(s, x, open.right));
    return whole;
}

// Rows above and below the picture.
void add_margin_rows(SourceLevel& level, int margin, const OpenEdges& open) {
    const auto repeat = [&](std::size_t from, std::size_t to, bool is_open) {
        for (const Source& s : level.rows[from]) level.rows[to].push_back(beyond_edge(s, s.x, is_open));
    };
    const std::size_t top = std::size_t(margin), bottom = level.rows.size() - 1 - top;
    for (std::size_t k = 0; k < top; ++k)
        repeat(top, k, open.top), repeat(bottom, bottom + 1 + k, open.bottom);
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
                                      View<const unsigned char> connected, const OpenEdges& open,
                                      const LevelRule& rule, int threads) {
    float largest = 0;
    for (const CocSample& s : samples.samples) largest = std::max(largest, std::abs(s.coc_px));
    const Maker maker(samples, coc_px, connected, rule);
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
        std::vector<std::vector<Cell>> row_cells(levels.size());  // of the row under way, per coarse level
        std::vector<Source> row_sources;
        const auto finish_row = [&](int l, int y) {
            levels[std::size_t(l)].rows[std::size_t(y + margin)] =
                with_margins(row_sources, cells(coc_px.width(), l), margin, open);
            row_sources.clear();
        };
        for (int l = 1; l <= coarsest; ++l)
            row_cells[std::size_t(l)].resize(std::size_t(cells(coc_px.width(), l)));
        for (int y = band * band_height; y < (band + 1) * band_height; ++y) {
            for (int x = 0; x < cells(coc_px.width(), coarsest) << coarsest; ++x)
                maker.visit(x, y, [&](int l, int layer, Rgba light, float coc, depth::Slope tilt) {
                    if (l > 0) {
                        if (std::size_t(x >> l) < row_cells[std::size_t(l)].size())
                            row_cells[std::size_t(l)][std::size_t(x >> l)].add(layer, light, coc, tilt);
                    } else if (x < coc_px.width() && y < coc_px.height()) {
                        row_sources.push_back({light, coc, tilt.x, tilt.y, x, layer});
                    }
                });
            if (y < coc_px.height()) finish_row(0, y);
            for (int l = 1; l <= coarsest; ++l) {
                const int row = y >> l;
                if ((y + 1) % (1 << l) != 0 || row >= cells(coc_px.height(), l)) continue;
                for (std::size_t x = 0; x < row_cells[std::size_t(l)].size(); ++x)
                    row_cells[std::size_t(l)][x].flush(int(x), 1 << l, row_sources);
                finish_row(l, row);
            }
        }
    });
    for (SourceLevel& level : levels) add_margin_rows(level, margin, open);
    return levels;
}

}  // namespace petzval::engine
