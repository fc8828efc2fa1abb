#include "engine/scatter/sources.h"

#include "base/parallel.h"
#include "engine/samples/connectivity.h"
#include "engine/scatter/stamp_table.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// The change of weight per pixel away from a source: a facet of a slanted surface is seen larger from one
// side of the pupil than from the other, by 1 + slope . u with u = offset / radius.
Slope tilt_of(Slope slope, float coc_px) {
    constexpr float kLeastRadiusPx = 0.5f;  // narrower discs stay within their pixel
    if (std::abs(coc_px) < kLeastRadiusPx) return {};
    return {slope.x / coc_px, slope.y / coc_px};
}

// What a cell gathers from its pixels for one source.
struct Gathered {
    int layer = 0, skirt_of = 0;
    Rgba light;                             // summed over pixels
    float coc = 0, tilt_x = 0, tilt_y = 0;  // summed times light.a
    float x = 0, y = 0;                     // the same, from the cell's first pixel
    Gathered() = default;
    Gathered(int in_layer, Rgba pixel, float coc_px, Slope tilt)
        : layer(in_layer),
          light(pixel),
          coc(pixel.a * coc_px),
          tilt_x(pixel.a * tilt.x),
          tilt_y(pixel.a * tilt.y) {}
    bool same_source(const Gathered& other) const {
        return layer == other.layer && skirt_of == other.skirt_of;
    }
    void operator+=(const Gathered& other) {
        light += other.light, coc += other.coc, tilt_x += other.tilt_x, tilt_y += other.tilt_y;
        x += other.x, y += other.y;
    }
    // The same in a cell whose first pixel lies (dx, dy) before that of this one.
    Gathered from(int dx, int dy) const {
        Gathered moved = *this;
        moved.x += light.a * float(dx), moved.y += light.a * float(dy);
        return moved;
    }
    // As a source at cell cell_x of a row of a level.
    Source source(int cell_x, int level) const {
        const float mean = 1 / light.a, size = float(1 << level);
        const auto off = [&](float sum) {
            constexpr float kLeast = 0.03f;  // less shows nowhere
            const float cells = (sum * mean + 0.5f) / size - 0.5f;
            return std::abs(cells) < kLeast ? 0.0f : cells;
        };
        return {light * (1 / (size * size)),
                radius_in_cells(coc * mean, level),
                tilt_x * mean * size,
                tilt_y * mean * size,
                cell_x,
                layer,
                level > 0 ? off(x) : 0,
                level > 0 ? off(y) : 0,
                skirt_of};
    }
};

// One cell of a coarse level: one source per layer and piece of kernel. Mostly there is one.
class Cell {
public:
    void add(const Gathered& more) {
        if (!used_) {
            first_ = more, used_ = true;
        } else if (first_.same_source(more)) {
            first_ += more;
        } else {
            for (Gathered& g : others_)
                if (g.same_source(more)) {
                    g += more;
                    return;
                }
            others_.push_back(more);
        }
    }
    // Visits what was gathered, and starts anew.
    template <typename Visit>
    void take(const Visit& visit) {
        if (used_) visit(first_);
        for (const Gathered& g : others_) visit(g);
        used_ = false, others_.clear();
    }

private:
    bool used_ = false;
    Gathered first_;
    std::vector<Gathered> others_;
};

// Visits every sample once and hands it to its level, or to two where one fades into the next.
class Maker {
public:
    Maker(const CocSamples& samples, View<const float> coc_px, View<const unsigned char> connected,
          const LevelRule& rule)
        : samples_(samples), coc_px_(coc_px), connected_(connected), rule_(rule) {}

    // Pixel (x, y), clamped to the picture; put(level, gathered).
    template <typename Put>
    void visit(int x, int y, const Put& put) const {
        const int u = std::min(x, coc_px_.width() - 1), v = std::min(y, coc_px_.height() - 1);
        LayersOfPixel layers;
        for (const CocSample& s : samples_.at(u, v)) {
            const int layer = layers.next(s);
            // Only what is seen has a known slope.
            const bool visible = std::abs(s.coc_px - coc_px_(u, v)) < 0.01f;
            const Slope slope = visible ? slope_at(coc_px_, connected_, u, v) : Slope{};
            const Slope tilt = tilt_of(slope, s.coc_px);
            const float at = rule_.position(s.coc_px);
            const int level = int(std::ceil(at));
            const float share = level == 0 ? 1.0f : std::min(1.0f, (at - float(level - 1)) / rule_.fade);
            const auto put_both = [&](int in_layer, Rgba light) {
                put(level, Gathered(in_layer, share * light, s.coc_px, tilt));
                if (share < 1) put(level - 1, Gathered(in_layer, (1 - share) * light, s.coc_px, tilt));
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
    s.x = x, s.off_x = s.off_y = 0;
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

// Fills the rows of all levels, from top to bottom; a band begins and ends on whole cells of every level.
class Band {
public:
    Band(std::vector<SourceLevel>& levels, const StampTable& table, int width, std::span<const int> margins,
         const OpenEdges& open)
        : levels_(levels),
          table_(table),
          width_(width),
          margins_(margins),
          open_(open),
          cells_(levels.size()),
          of_row_(levels.size()) {
        // As many cells as the coarsest level spans: those beyond the picture give to larger ones.
        const int coarsest = int(levels.size()) - 1;
        for (int l = 1; l <= coarsest; ++l)
            cells_[std::size_t(l)].resize(std::size_t(cells_across(coarsest)) << (coarsest - l));
        for (int l = kWideLevel; l <= coarsest; ++l)
            of_row_[std::size_t(l)].resize(cells_[std::size_t(l)].size());
    }
    // What column x of the row under way gives to a level; columns beyond the picture only fill its last
    // cells.
    void put(int level, int x, int y, const Gathered& g) {
        if (level > 0) return add_to_cell(level, x, y, g);
        const Source source = g.source(x, 0);
        if (x < width_) fine_.push_back(source);
        send_skirt(source, 0, x, y, g);
    }
    // Ends row y of pixels, and the rows of cells that end there.
    void finish_row(int y) {
        store(0, y, fine_);
        for (int l = 1; l < int(levels_.size()); ++l) {
            for (std::size_t x = 0; x < of_row_[std::size_t(l)].size(); ++x)
                of_row_[std::size_t(l)][x].take([&](const Gathered& g) { cells_[std::size_t(l)][x].add(g); });
            if ((y + 1) % (1 << l) != 0) continue;
            row_.clear();
            for (int x = 0; x < int(cells_[std::size_t(l)].size()); ++x) {
                cells_[std::size_t(l)][std::size_t(x)].take([&](const Gathered& g) {
                    const Source source = g.source(x, l);
                    if (x < cells_across(l)) row_.push_back(source);
                    send_skirt(source, l, x << l, y >> l << l, g);
                });
            }
            store(l, y >> l, row_);
        }
        fine_.clear();
    }

private:
    int cells_across(int level) const { return ((width_ - 1) >> level) + 1; }
    // What lies in (a cell that begins at) pixel (x, y).
    void add_to_cell(int level, int x, int y, const Gathered& g) {
        const int within = (1 << level) - 1;
        auto& cells = level < kWideLevel ? cells_ : of_row_;
        cells[std::size_t(level)][std::size_t(x >> level)].add(g.from(x & within, y & within));
    }
    void send_skirt(const Source& source, int level, int x, int y, Gathered g) {
        if (g.skirt_of > 0) return;
        g.skirt_of = std::min(table_.skirt_levels(level, source.radius), int(levels_.size()) - 1 - level);
        if (g.skirt_of > 0) add_to_cell(level + g.skirt_of, x, y, g);
    }
    void store(int level, int y, std::span<const Source> row) {
        const int margin = margins_[std::size_t(level)];
        auto& rows = levels_[std::size_t(level)].rows;
        if (std::size_t(y + 2 * margin) < rows.size())
            rows[std::size_t(y + margin)] = with_margins(row, cells_across(level), margin, open_);
    }

    std::vector<SourceLevel>& levels_;
    const StampTable& table_;
    int width_;
    std::span<const int> margins_;
    const OpenEdges& open_;
    std::vector<Source> fine_, row_;        // of the row of pixels under way; of a row of cells
    std::vector<std::vector<Cell>> cells_;  // per coarse level, of the row of cells under way
    // Of wide cells, what the row of pixels under way gives: one sum of millions in single precision would
    // lose some of them.
    static constexpr int kWideLevel = 6;
    std::vector<std::vector<Cell>> of_row_;
};

}  // namespace

// A square of side a adds a^2/12 to the mean square along each axis, a disc of radius r has r^2/4.
float radius_in_cells(float coc_px, int level) {
    const float size = float(1 << level), square = coc_px * coc_px - (size * size - 1) / 3;
    return level == 0 ? coc_px : std::copysign(std::sqrt(std::max(0.0f, square)) / size, coc_px);
}

float radius_in_pixels(float radius, int level) {
    const float size = float(1 << level), square = radius * radius * size * size;
    return level == 0 ? radius : std::copysign(std::sqrt(square + (size * size - 1) / 3), radius);
}

float LevelRule::position(float coc_px) const {
    const float octaves = std::log2(std::max(1.0f, std::abs(coc_px) / largest_cells));
    return std::min(octaves / kOctavesPerLevel, octaves + 1);
}

float LevelRule::end_of_level(int level) const {
    return largest_cells * std::exp2(std::max(kOctavesPerLevel * float(level), float(level) - 1));
}

float LevelRule::largest_radius() const { return largest_cells * std::exp2(kOctavesPerLevel * fade); }

std::vector<SourceLevel> make_sources(const CocSamples& samples, View<const float> coc_px,
                                      View<const unsigned char> connected, const OpenEdges& open,
                                      const LevelRule& rule, const StampTable& table, int threads) {
    float largest = 0;
    for (const CocSample& s : samples.samples) largest = std::max(largest, std::abs(s.coc_px));
    const Maker maker(samples, coc_px, connected, rule);
    const int coarsest = table.coarsest_for(int(std::ceil(rule.position(largest))));
    const auto cells = [](int pixels, int level) { return ((pixels - 1) >> level) + 1; };
    std::vector<SourceLevel> levels(std::size_t(coarsest) + 1);
    std::vector<int> margins;
    constexpr int kAround = 4;  // cells read around a tile, and sources that lie off their cell's middle
    for (int l = 0; l <= coarsest; ++l) {
        const int margin = table.reach(l) + kAround;
        margins.push_back(margin);
        levels[std::size_t(l)].area =
            Rect{0, 0, cells(coc_px.width(), l), cells(coc_px.height(), l)}.grown(margin);
        levels[std::size_t(l)].rows.resize(std::size_t(levels[std::size_t(l)].area.height()));
    }
    // A band of rows as tall as the largest cell is done by one thread.
    const int band_height = 1 << coarsest;
    parallel_for(cells(coc_px.height(), coarsest), threads, [&](int band) {
        Band rows(levels, table, coc_px.width(), margins, open);
        for (int y = band * band_height; y < (band + 1) * band_height; ++y) {
            for (int x = 0; x < cells(coc_px.width(), coarsest) << coarsest; ++x)
                maker.visit(x, y, [&](int level, const Gathered& g) { rows.put(level, x, y, g); });
            rows.finish_row(y);
        }
    });
    for (std::size_t l = 0; l < levels.size(); ++l) add_margin_rows(levels[l], margins[l], open);
    return levels;
}

}  // namespace petzval::engine
