#include "engine/scatter/sources.h"

#include "base/parallel.h"
#include "engine/samples/silhouettes/connectivity.h"
#include "engine/scatter/scatter_kernels.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace petzval::engine {
namespace {

// The change of weight per pixel away from a source: a facet of a slanted surface is seen larger from one
// side of the pupil than from the other, by 1 + slope . u with u = offset / radius.
Slope tilt_of(Slope slope, float coc_px) {
    if (std::abs(coc_px) < laws::kWithinPixelPx) return {};
    return {slope.x / coc_px, slope.y / coc_px};
}

// Coverage, of a pixel, below which a sample sends nothing: no sum shows it, and sources are means by
// coverage, which far below this are no longer finite. (Thick smoke dims what is behind it to any number.)
constexpr float kLeastCoverage = 1e-20f;

// Light that a cell gathers from its pixels for one source. Requires: coverage from kLeastCoverage on.
struct Gathered {
    int layer = 0, skirt_of = 0;
    Rgba light;                             // summed over pixels
    float coc = 0, tilt_x = 0, tilt_y = 0;  // sums weighted by light.a
    float x = 0, y = 0;                     // the same for the place in the cell, from its first pixel
    Gathered() = default;
    // A square of `side` x `side` pixels, each with this light.
    Gathered(int in_layer, Rgba pixel, float coc_px, Slope tilt, int side)
        : layer(in_layer),
          light(float(side * side) * pixel),
          coc(light.a * coc_px),
          tilt_x(light.a * tilt.x),
          tilt_y(light.a * tilt.y),
          x(0.5f * float(side - 1) * light.a),
          y(x) {}
    bool same_source(const Gathered& other) const {
        return layer == other.layer && skirt_of == other.skirt_of;
    }
    void operator+=(const Gathered& other) {
        light += other.light, coc += other.coc, tilt_x += other.tilt_x, tilt_y += other.tilt_y;
        x += other.x, y += other.y;
    }
    // The same light, in a cell whose first pixel lies (dx, dy) before that of this cell.
    Gathered from(int dx, int dy) const {
        Gathered moved = *this;
        moved.x += light.a * float(dx), moved.y += light.a * float(dy);
        return moved;
    }
    // The source at cell cell_x of a row of a level.
    Source source(int cell_x, int cell_y, int level) const {
        const float mean = 1 / light.a, size = float(1 << level);
        const auto off = [&](float sum) {
            constexpr float kLeast = 0.03f;  // smaller tilts are invisible
            const float cells = (sum * mean + 0.5f) / size - 0.5f;
            return std::abs(cells) < kLeast ? 0.0f : cells;
        };
        return {light * (1 / (size * size)),
                radius_in_cells(coc * mean, level),
                tilt_x * mean * size,
                tilt_y * mean * size,
                level > 0 ? off(x) : 0,
                level > 0 ? off(y) : 0,
                layer,
                cell_x,
                Source::packed(cell_y, skirt_of)};
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
    // `samples` are rows from first_row on.
    Maker(const CocSamplesView& samples, int first_row, View<const float> coc_px,
          View<const unsigned char> connected, const LevelRule& rule)
        : samples_(samples), first_row_(first_row), coc_px_(coc_px), connected_(connected), rule_(rule) {
        for (int i = 0; i < kSquares; ++i) from_px_[std::size_t(i)] = rule.radius_at(float(i) + rule.fade);
    }

    // Gathers pixel (x, y), clamped to the picture, and calls put(level, gathered).
    template <typename Put>
    void visit(int x, int y, const Put& put) const {
        const int u = std::min(x, coc_px_.width() - 1), v = std::min(y, coc_px_.height() - 1);
        visit(samples_.at(u, v - first_row_), u, v, 1, put);
    }
    // Gathers the square of pixels that begins at (x, y) as one and calls put(level, gathered). Returns
    // its side; 1 if there is no square, and then nothing was put.
    template <typename Put>
    int visit_square(int x, int y, const Put& put) const {
        std::array<CocSample, kMostOfSquare> means;
        for (int i = largest_square_at(x, y); i > 0; --i) {
            const int side = 1 << i;
            const std::size_t count =
                means_of({x, y, x + side, y + side}, from_px_[std::size_t(i - 1)], means);
            if (count == 0) continue;
            visit(std::span(means).first(count), x + side / 2, y + side / 2, side, put);
            return side;
        }
        return 1;
    }

private:
    // Samples of pixel (u, v), or of a square of pixels around that.
    template <typename Put>
    void visit(std::span<const CocSample> samples, int u, int v, int side, const Put& put) const {
        LayersOfPixel layers(rule_.hidden_known);
        const auto own = samples_.at(u, v - first_row_);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const CocSample& s = samples[k];
            const auto [layer, shows] = layers.next(s);
            // Only what is seen has a known slope.
            const bool visible = std::abs(own[k].coc_px - coc_px_(u, v)) < 0.01f;
            const Slope slope = visible ? slope_at(coc_px_, connected_, u, v) : Slope{};
            const Slope tilt = tilt_of(slope, s.coc_px);
            const float at = rule_.position(s.coc_px);
            const int level = int(std::ceil(at));
            const float share = level == 0 ? 1.0f : std::min(1.0f, (at - float(level - 1)) / rule_.fade);
            const auto put_one = [&](int on_level, int in_layer, Rgba light) {
                if (light.a >= kLeastCoverage) put(on_level, Gathered(in_layer, light, s.coc_px, tilt, side));
            };
            const auto put_both = [&](int in_layer, Rgba light) {
                put_one(level, in_layer, share * light);
                put_one(level - 1, in_layer, (1 - share) * light);
            };
            put_both(layer, shows * s.colour);
            put_both(layer + kNextLayer, (1 - shows) * s.colour);
            put_both(is_behind_everything(s) ? kEmptyLayer : layer + kEmptinessAfter, {0, 0, 0, s.empty});
        }
    }
    // Binary logarithm of the side of the largest square whose first pixel is (x, y).
    int largest_square_at(int x, int y) const {
        if (x >= coc_px_.width() || y >= coc_px_.height()) return 0;
        const auto first = samples_.at(x, y - first_row_);
        if (first.empty() || first.size() > kMostOfSquare) return 0;
        float least = std::abs(first[0].coc_px);
        for (const CocSample& s : first) least = std::min(least, std::abs(s.coc_px));
        const auto fits = [&](int i) {
            const int side = 2 << i;
            return i < kSquares && least >= from_px_[std::size_t(i)] && (x | y) % side == 0 &&
                   x + side <= coc_px_.width() && y + side <= coc_px_.height();
        };
        int i = 0;
        while (fits(i)) ++i;
        return i;
    }
    // The means of a square's samples, one of each surface, and how many: 0, if its pixels do not all have
    // those of the first, of nearly the same radius, of at least from_px, and as much coverage.
    std::size_t means_of(const Rect& square, float from_px, std::span<CocSample> means) const {
        constexpr float kSameRadius = 0.05f, kSameShare = 0.01f;
        const auto first = samples_.at(square.x0, square.y0 - first_row_);
        std::array<CocSample, kMostOfSquare> sums{};
        for (int y = square.y0; y < square.y1; ++y)
            for (int x = square.x0; x < square.x1; ++x) {
                const auto samples = samples_.at(x, y - first_row_);
                if (samples.size() != first.size()) return 0;
                for (std::size_t k = 0; k < samples.size(); ++k) {
                    const CocSample &s = samples[k], &f = first[k];
                    if (std::abs(s.coc_px) < from_px ||
                        std::abs(s.coc_px - f.coc_px) > kSameRadius * std::abs(f.coc_px) ||
                        std::abs(s.colour.a - f.colour.a) > kSameShare ||
                        std::abs(s.empty - f.empty) > kSameShare)
                        return 0;
                    sums[k].colour += s.colour, sums[k].coc_px += s.coc_px, sums[k].empty += s.empty;
                }
            }
        const float share = 1 / float(square.width() * square.height());
        for (std::size_t k = 0; k < first.size(); ++k)
            means[k] = {share * sums[k].colour, share * sums[k].coc_px, first[k].coc_back_px,
                        share * sums[k].empty};
        return first.size();
    }

    static constexpr std::size_t kMostOfSquare = 4;  // most samples of a pixel in a square
    static constexpr int kSquares = 3;
    std::array<float, kSquares> from_px_;  // |radius| from which on pixels form squares of 2, of 4, of 8
    CocSamplesView samples_;
    int first_row_;
    View<const float> coc_px_;
    View<const unsigned char> connected_;
    LevelRule rule_;
};

// Rows of cells of one level, as a band leaves them.
struct Rows {
    BigVector<Source> sources;
    std::vector<std::uint32_t> ends;  // per row: end of its sources
    void end_row() { ends.push_back(std::uint32_t(sources.size())); }
};

// One level: the rows of all bands, with `margin` cells more around the picture. A source of an outermost
// cell is repeated there: beyond an open edge the picture continues, beyond a closed one is emptiness.
class LevelBuilder {
public:
    LevelBuilder(int width, int height, int margin, const OpenEdges& open)
        : width_(width), height_(height), margin_(margin), open_(open) {
        array_.area = Rect{0, 0, width, height}.grown(margin);
    }
    int height() const { return height_; }

    // Places the sources of rows first…first+n-1; all rows before must be placed.
    void place(const Rows& rows) {
        std::uint32_t begin = 0;
        for (const std::uint32_t end : rows.ends) {
            const std::span<const Source> row(rows.sources.data() + begin, end - begin);
            counts_.push_back(std::uint32_t(row.size() + std::size_t(margin_) * (head(row) + tail(row))));
            begin = end;
        }
    }
    void allocate() {
        const int rows = array_.area.height();
        array_.first.assign(std::size_t(rows) + 1, 0);
        for (int i = 0; i < rows; ++i)
            array_.first[std::size_t(i) + 1] =
                array_.first[std::size_t(i)] + counts_[std::size_t(std::clamp(i - margin_, 0, height_ - 1))];
        array_.sources.resize(array_.first.back());
    }
    // Fills the rows from row `first` of the picture.
    void fill(const Rows& rows, int first) {
        std::uint32_t begin = 0;
        for (std::size_t i = 0; i < rows.ends.size(); ++i) {
            fill_row({rows.sources.data() + begin, rows.ends[i] - begin}, first + int(i));
            begin = rows.ends[i];
        }
    }
    // The rows above and below the picture, once those in it are there.
    SourceArray finish() {
        for (int k = 0; k < margin_; ++k) {
            repeat(0, k - margin_, open_.top);
            repeat(height_ - 1, height_ + k, open_.bottom);
        }
        return std::move(array_);
    }

private:
    // Number of sources in the first cell of a row, and in the last one; sources ascend in x.
    static std::size_t head(std::span<const Source> row) {
        std::size_t n = 0;
        while (n < row.size() && row[n].x == 0) ++n;
        return n;
    }
    std::size_t tail(std::span<const Source> row) const {
        std::size_t n = 0;
        while (n < row.size() && row[row.size() - 1 - n].x == width_ - 1) ++n;
        return n;
    }
    Source* at_row(int y) { return array_.sources.data() + array_.first[std::size_t(y + margin_)]; }
    static Source beyond_edge(Source s, int x, int y, bool open) {
        s.x = x, s.row_and_skirt = Source::packed(y, s.skirt_of()), s.off_x = s.off_y = 0;
        if (!open) s.light = {0, 0, 0, s.light.a}, s.layer = kEmptyLayer, s.tilt_x = s.tilt_y = 0;
        return s;
    }
    void fill_row(std::span<const Source> row, int y) {
        Source* out = at_row(y);
        const auto first = row.first(head(row)), last = row.last(tail(row));
        for (int x = -margin_; x < 0; ++x)
            for (const Source& s : first) *out++ = beyond_edge(s, x, y, open_.left);
        out = std::copy(row.begin(), row.end(), out);
        for (int x = width_; x < width_ + margin_; ++x)
            for (const Source& s : last) *out++ = beyond_edge(s, x, y, open_.right);
    }
    void repeat(int from, int to, bool open) {
        Source* out = at_row(to);
        for (const Source *s = at_row(from), *end = at_row(from + 1); s != end; ++s)
            *out++ = beyond_edge(*s, s->x, to, open);
    }

    int width_, height_, margin_;
    OpenEdges open_;
    std::vector<std::uint32_t> counts_;  // per row of the picture
    SourceArray array_;
};

// Fills the rows of all levels, from top to bottom; a band begins and ends on whole cells of every level.
class Band {
public:
    Band(std::span<const LevelBuilder> levels, const ScatterKernels& kernels, int width, int rows)
        : levels_(levels),
          kernels_(kernels),
          width_(width),
          rows_(levels.size()),
          cells_(levels.size()),
          of_row_(levels.size()) {
        // The cells that the coarsest level spans: those beyond the picture feed larger cells.
        const int coarsest = int(levels.size()) - 1;
        for (int l = 1; l <= coarsest; ++l)
            cells_[std::size_t(l)].resize(std::size_t(cells_across(coarsest)) << (coarsest - l));
        // Most cells hold one source; reserved room that is not written costs no memory.
        for (int l = 0; l <= coarsest; ++l)
            rows_[std::size_t(l)].sources.reserve(std::size_t(cells_across(l)) *
                                                  std::size_t(((rows - 1) >> l) + 1));
        for (int l = kWideLevel; l <= coarsest; ++l)
            of_row_[std::size_t(l)].resize(cells_[std::size_t(l)].size());
    }
    // Adds column x of the current row to a level; columns beyond the picture only fill its last cells.
    void put(int level, int x, int y, const Gathered& g) {
        if (level > 0) return add_to_cell(level, x, y, g);
        const Source source = g.source(x, y, 0);
        if (x < width_) rows_[0].sources.push_back(source);
        send_skirt(source, 0, x, y, g);
    }
    // Ends row y of pixels, and the rows of cells that end there.
    void finish_row(int y) {
        end_row(0, y);
        for (int l = 1; l < int(levels_.size()); ++l) {
            for (std::size_t x = 0; x < of_row_[std::size_t(l)].size(); ++x)
                of_row_[std::size_t(l)][x].take([&](const Gathered& g) { cells_[std::size_t(l)][x].add(g); });
            if ((y + 1) % (1 << l) != 0) continue;
            for (int x = 0; x < int(cells_[std::size_t(l)].size()); ++x) {
                cells_[std::size_t(l)][std::size_t(x)].take([&](const Gathered& g) {
                    const Source source = g.source(x, y >> l, l);
                    if (x < cells_across(l)) rows_[std::size_t(l)].sources.push_back(source);
                    send_skirt(source, l, x << l, y >> l << l, g);
                });
            }
            end_row(l, y >> l);
        }
    }
    std::vector<Rows> take() { return std::move(rows_); }

private:
    int cells_across(int level) const { return ((width_ - 1) >> level) + 1; }
    // Adds light to the cell that begins at pixel (x, y).
    void add_to_cell(int level, int x, int y, const Gathered& g) {
        const int within = (1 << level) - 1;
        auto& cells = level < kWideLevel ? cells_ : of_row_;
        cells[std::size_t(level)][std::size_t(x >> level)].add(g.from(x & within, y & within));
    }
    void send_skirt(const Source& source, int level, int x, int y, Gathered g) {
        if (g.skirt_of > 0) return;
        g.skirt_of = std::min(kernels_.skirt_levels(level, source.radius), int(levels_.size()) - 1 - level);
        if (g.skirt_of > 0) add_to_cell(level + g.skirt_of, x, y, g);
    }
    // Rows beyond the picture only fill its last cells.
    void end_row(int level, int y) {
        Rows& rows = rows_[std::size_t(level)];
        if (y < levels_[std::size_t(level)].height())
            rows.end_row();
        else
            rows.sources.resize(rows.ends.empty() ? 0 : rows.ends.back());
    }

    std::span<const LevelBuilder> levels_;
    const ScatterKernels& kernels_;
    int width_;
    std::vector<Rows> rows_;                // per level
    std::vector<std::vector<Cell>> cells_;  // per coarse level: the row of cells under way
    // Sums of the current row of pixels, for wide cells: one sum of millions in single precision would lose
    // light.
    static constexpr int kWideLevel = 6;
    std::vector<std::vector<Cell>> of_row_;
};

// Pixels of the picture, and those beyond it that fill its last cells.
void gather(const Maker& maker, const Rect& pixels, bool squares, Band& band) {
    // Per pair of columns: rows that are done.
    std::vector<int> done(std::size_t(pixels.width() + 1) / 2, pixels.y0);
    for (int y = pixels.y0; y < pixels.y1; ++y) {
        for (int x = 0; x < pixels.x1;) {
            const auto put = [&](int level, const Gathered& g) { band.put(level, x, y, g); };
            if (done[std::size_t(x / 2)] > y) {
                x += 2;
                continue;
            }
            const int side = squares && (x | y) % 2 == 0 ? maker.visit_square(x, y, put) : 1;
            if (side == 1)
                maker.visit(x, y, put);
            else
                std::fill_n(done.begin() + x / 2, side / 2, y + side);
            x += side;
        }
        band.finish_row(y);
    }
}

}  // namespace

std::vector<SourceArray> make_sources(SampleSource samples, View<const float> coc_px,
                                      View<const unsigned char> connected, const OpenEdges& open,
                                      const LevelRule& rule, const ScatterKernels& kernels,
                                      Workers& workers) {
    const int coarsest = kernels.coarsest_for(int(std::ceil(rule.position(samples.largest_coc_px()))));
    const auto cells = [](int pixels, int level) { return ((pixels - 1) >> level) + 1; };
    std::vector<LevelBuilder> levels;
    constexpr int kAround = 4;  // cells read around a tile, and sources that lie off their cell's middle
    for (int l = 0; l <= coarsest; ++l)
        levels.emplace_back(cells(coc_px.width(), l), cells(coc_px.height(), l), kernels.reach(l) + kAround,
                            open);
    // A band of rows as tall as the largest cell, or more, is done by one thread.
    const int band_height = std::max(1 << coarsest, SampleSource::kRows);
    const int height = coc_px.height(), bands = (height + band_height - 1) / band_height;
    std::vector<std::vector<Rows>> rows(static_cast<std::size_t>(bands));
    parallel_for(bands, workers, [&](int i) {
        const int y0 = i * band_height, y1 = std::min(y0 + band_height, cells(height, coarsest) << coarsest);
        Band band(levels, kernels, coc_px.width(), y1 - y0);
        samples.rows(y0, std::min(y1, height), [&](const CocSamplesView& of_band) {
            const Maker maker(of_band, y0, coc_px, connected, rule);
            gather(maker, {0, y0, cells(coc_px.width(), coarsest) << coarsest, y1}, rule.gathers_squares,
                   band);
        });
        rows[std::size_t(i)] = band.take();
    });
    samples = {};
    for (std::size_t l = 0; l < levels.size(); ++l) {
        for (const std::vector<Rows>& band : rows) levels[l].place(band[l]);
        levels[l].allocate();
    }
    parallel_for(bands, workers, [&](int i) {
        for (int l = 0; l <= coarsest; ++l)
            levels[std::size_t(l)].fill(rows[std::size_t(i)][std::size_t(l)], i * band_height >> l);
        rows[std::size_t(i)] = {};
    });
    std::vector<SourceArray> arrays;
    for (LevelBuilder& level : levels) arrays.push_back(level.finish());
    return arrays;
}

}  // namespace petzval::engine
