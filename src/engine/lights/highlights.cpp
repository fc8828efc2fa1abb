#include "engine/lights/highlights.h"

#include "base/content_hash.h"
#include "base/parallel.h"
#include "engine/samples/deep/end_of_pixel.h"
#include "engine/samples/seen_share.h"
#include "engine/samples/white.h"
#include "image/two_sweeps.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace petzval::engine {
namespace {

constexpr int kNarrowReach = 1, kWideReach = 3;  // cells on either side: 12 and 28 pixels

// Mean of 1 / (luminance + black) over cells of `size` pixels. Its reciprocal, the harmonic mean, follows
// what most of the cell shows and hardly moves for a few bright pixels.
Plane reciprocal_cells(View<const Rgba> picture, int size, float black, Workers& workers) {
    Plane cells((picture.width() + size - 1) / size, (picture.height() + size - 1) / size);
    parallel_for(cells.height(), workers, [&](int cy) {
        for (int cx = 0; cx < cells.width(); ++cx) {
            const Rect r =
                Rect{cx * size, cy * size, (cx + 1) * size, (cy + 1) * size}.intersected(picture.rect());
            float sum = 0;
            for (int y = r.y0; y < r.y1; ++y)
                for (int x = r.x0; x < r.x1; ++x)
                    sum += 1 / (std::max(0.0f, luminance(picture(x, y))) + black);
            cells(cx, cy) = sum / float(r.width() * r.height());
        }
    });
    return cells;
}

float box_mean(View<const float> cells, int cx, int cy, int reach) {
    const Rect r = Rect{cx - reach, cy - reach, cx + reach + 1, cy + reach + 1}.intersected(cells.rect());
    float sum = 0;
    for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x) sum += cells(x, y);
    return sum / float(r.width() * r.height());
}

}  // namespace

float radius_of_brightest(View<const Rgba> colour, View<const float> coc_px, int x, int y) {
    float brightest = luminance(colour(x, y)), coc = coc_px(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(colour.height() - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(colour.width() - 1, x + 1); ++u)
            if (const float there = luminance(colour(u, v)); there > brightest)
                brightest = there, coc = coc_px(u, v);
    return coc;
}

HighlightSplit::HighlightSplit(const EngineView& input, const HighlightRule& rule)
    : rule_(rule),
      colour_(input.samples.judged()),
      stated_(input.samples.are_stated() ? input.samples.deep : CocSamplesView{}),
      coc_px_(input.samples.coc_px),
      width_(input.width()),
      height_(input.height()) {
    Workers& workers = *input.services.workers;
    if (rule.contested_floor < rule.least_floor || rule.floor_at_1px > 0)
        find_contested(input.samples.coc_px, workers);
    white_ = white_of(input.all().samples.judged(), workers);
    const float black = black_of(white_);
    const Plane reciprocal = reciprocal_cells(input.samples.judged(), kCell, black, workers);
    surroundings_ = Plane(reciprocal.width(), reciprocal.height());
    parallel_for(reciprocal.height(), workers, [&](int y) {
        for (int x = 0; x < reciprocal.width(); ++x) {
            const float narrow = 1 / box_mean(reciprocal, x, y, kNarrowReach);
            const float wide = 1 / box_mean(reciprocal, x, y, kWideReach);
            surroundings_(x, y) = std::max(0.0f, std::min(narrow, 2 * wide) - black);
        }
    });
}

// A surface at radius n, d pixels away, stands in the way of radius c if c - n > d: c > min(n + d) over all
// surfaces, which is a distance transform of the blocks' nearest
// radii.
void HighlightSplit::find_contested(View<const float> coc_px, Workers& workers) {
    contested_ =
        Plane((coc_px.width() + kBlock - 1) / kBlock, (coc_px.height() + kBlock - 1) / kBlock, 1e30f);
    parallel_for(contested_.height(), workers, [&](int by) {
        for (int y = by * kBlock; y < std::min((by + 1) * kBlock, coc_px.height()); ++y)
            for (int x = 0; x < coc_px.width(); ++x)
                contested_(x / kBlock, by) =
                    std::min(contested_(x / kBlock, by), coc_px(x, y) + laws::kHidesLittlePx);
    });
    two_sweeps(contested_.width(), contested_.height(), [&](int x, int y, int dx, int dy) {
        const float step = chamfer_step(dx, dy) * kBlock;
        contested_(x, y) = std::min(contested_(x, y), contested_(x + dx, y + dy) + step);
    });
}

std::uint64_t HighlightSplit::name() const {
    return hash_of(surroundings_.pixels(), surroundings_.size() * sizeof(float), 1);
}

float HighlightSplit::floor_at(int x, int y, float coc_px) const {
    const float radius = std::abs(coc_px);
    const float open = std::max(rule_.least_floor, rule_.floor_at_1px * radius * std::sqrt(radius));
    // The base continues beyond the frame, highlights do not: near its edge only true ones count.
    const int to_edge = std::min(std::min(x, width_ - 1 - x), std::min(y, height_ - 1 - y));
    const bool contested =
        !contested_.empty() && coc_px > contested_(x / kBlock, y / kBlock) && float(to_edge) >= radius + 1;
    if (!contested) return white_ * open;
    constexpr float kRisesFromPx = 8;  // a wide disc of little light shows no shadow
    return white_ * std::min(open, rule_.contested_floor * std::max(1.0f, radius / kRisesFromPx));
}

Rgba HighlightSplit::dim(int x, int y, Rgba light) const {
    const float brightness = luminance(light), least = least_of_lamps() * light.a;
    if (brightness <= least || light.a <= kLeastAlpha) return light;
    const float around = light.a * surroundings_(x / kCell, y / kCell);
    const float bound = least + rule_.lamp_factor * around;
    if (brightness <= bound) return light;
    // Brighter light says less about the surface: it is reduced from the bound down to its surroundings.
    const Rgba scaled = light * (std::max(around, bound * (bound / brightness)) / brightness);
    return {scaled.r, scaled.g, scaled.b, light.a};
}

bool HighlightSplit::is_flat(int x, int y) const { return !stated_.empty() && is_flat_pixel(stated_, x, y); }

float HighlightSplit::radius_of_light(int x, int y, float coc_px) const {
    if ((!stated_.empty() && !is_flat(x, y)) || dim(x, y, colour_(x, y)) == colour_(x, y)) return coc_px;
    const float coc = radius_of_brightest(colour_, coc_px_, x, y);
    return coc < coc_px && laws::same_surface(laws::kConnected, coc, coc_px) ? coc : coc_px;
}

PartOfPixel HighlightSplit::part_of_lamp(int x, int y) const {
    const float around = surroundings_(x / kCell, y / kCell);
    const auto along = [&](int dx, int dy) {
        bool is_lamp = false;
        const auto brightness = [&](int u, int v) {
            const Rgba light = colour_(std::clamp(u, 0, width_ - 1), std::clamp(v, 0, height_ - 1));
            is_lamp = is_lamp || !(dim(x, y, light) == light);
            return luminance(light) - around;
        };
        const float before = brightness(x - dx, y - dy), own = brightness(x, y);
        const float after = brightness(x + dx, y + dy);
        return is_lamp ? part_along(before, own, after) : PartOfPixel::kPoint;
    };
    return {along(1, 0), along(0, 1)};
}

Rgba HighlightSplit::base(int x, int y, float coc_px, Rgba light) const {
    const float brightness = luminance(light);
    if (light.a <= kLeastAlpha) return {0, 0, 0, light.a};
    if (std::abs(coc_px) > kWidestHighlightPx || is_dim(brightness, light.a)) return light;
    if (x == 0 || y == 0 || x == width_ - 1 || y == height_ - 1) return dim(x, y, light);
    const float surroundings = surroundings_(x / kCell, y / kCell);
    const float bound = light.a * (floor_at(x, y, coc_px) + rule_.factor * surroundings);
    if (brightness <= bound) return light;
    const Rgba scaled = light * (bound / brightness);
    return {scaled.r, scaled.g, scaled.b, light.a};
}

namespace {

// Minimum number of squares per radius: a wide square in a small disc would smear the shadows of occluders.
// In light no brighter than white, such as a sky behind leaves, that is less visible, and there is much of
// it.
constexpr float kSquaresPerRadius = 4, kDimSquaresPerRadius = 3;
constexpr float kSameRadius = 0.01f;  // pixels of a square differ by less than this share of their radius

// Light taken from one sample.
struct Taken {
    Rgba colour;
    std::size_t sample = 0;
    float leaves = 1;  // share of it that leaves the pixel
    PartOfPixel part{};
    bool is_shown = false;
};

// The front-most bright samples of a block of kLargestSquare pixels on a side, to be divided into squares.
class Block {
public:
    // The block's first pixel; rows count from first_row of the picture.
    Block(int x, int y, int first_row) : x_(x), y_(y), first_row_(first_row) {}

    void put(int x, int y, float coc_px, const Taken& taken) {
        Cell& c = cell(x - x_, y - y_);
        c = {taken, coc_px, true};
    }
    // Takes squares of `size` that have light in common.
    void take_squares(int size, const HighlightSplit& split, std::vector<Highlight>& out) {
        for (int y = 0; y < kLargestSquare; y += size)
            for (int x = 0; x < kLargestSquare; x += size) {
                Rgba common = cell(x, y).taken.colour;
                const float coc = cell(x, y).coc_px, leaves = cell(x, y).taken.leaves;
                bool all = true;
                for_square(x, y, size, [&](const Cell& c) {
                    all = all && c.lit && c.taken.leaves == leaves &&
                          std::abs(c.coc_px - coc) <= kSameRadius * std::abs(coc) + 0.02f;
                    common = {std::min(common.r, c.taken.colour.r), std::min(common.g, c.taken.colour.g),
                              std::min(common.b, c.taken.colour.b), 0};
                });
                const bool dim = luminance(common) <= split.white();
                const bool narrow =
                    float(size) * (dim ? kDimSquaresPerRadius : kSquaresPerRadius) <= std::abs(coc);
                if (!all || !narrow || split.may_stay(x_ + x, first_row_ + y_ + y, coc, luminance(common)))
                    continue;
                for_square(x, y, size, [&](Cell& c) { c.taken.colour -= common; });
                out.push_back({x_ + x, y_ + y, size, coc, leaves * common});
            }
    }
    // Assigns the rest: pixel by pixel, or back to the base.
    void finish(const HighlightSplit& split, CocSamples& samples, std::vector<Highlight>& out) {
        for (int y = 0; y < kLargestSquare; ++y)
            for (int x = 0; x < kLargestSquare; ++x) {
                const Cell& c = cell(x, y);
                if (!c.lit || c.taken.colour == Rgba{}) continue;
                if (split.may_stay(x_ + x, first_row_ + y_ + y, c.coc_px, luminance(c.taken.colour)) &&
                    samples.samples[c.taken.sample].colour.a > HighlightSplit::kLeastAlpha)
                    samples.samples[c.taken.sample].colour += c.taken.colour;
                else
                    out.push_back({x_ + x, y_ + y, 1, c.coc_px, c.taken.leaves * c.taken.colour, c.taken.part,
                                   c.taken.is_shown});
            }
    }

private:
    struct Cell {
        Taken taken;
        float coc_px = 0;
        bool lit = false;
    };
    Cell& cell(int x, int y) { return cells_[y * kLargestSquare + x]; }
    template <typename Visit>
    void for_square(int x0, int y0, int size, const Visit& visit) {
        for (int y = y0; y < y0 + size; ++y)
            for (int x = x0; x < x0 + size; ++x) visit(cell(x, y));
    }
    int x_, y_, first_row_;
    Cell cells_[kLargestSquare * kLargestSquare];
};

// Share of the last sample's light that the nearer samples (nearest first) let through before it leaves the
// pixel.
float share_that_leaves(std::span<const CocSample> samples, float same_pixel_px) {
    float open = 1;
    const float own = samples.back().coc_px;
    for (const CocSample& s : samples.first(samples.size() - 1))
        if (own - s.coc_px <= same_pixel_px) open *= 1 - s.colour.a;
    return open;
}

// Rows of samples from which light is taken; first_row is the picture's row of the first one.
struct Rows {
    CocSamples& samples;
    const HighlightSplit& split;
    int first_row;
};

// Takes the light of the samples of pixel (x, y): the front-most bright one goes into the block, which is
// made for the first such pixel, and all others are highlights of one pixel.
void take_pixel(const Rows& rows, int x, int y, std::optional<Block>& block, std::vector<Highlight>& out) {
    CocSamples& samples = rows.samples;
    const HighlightSplit& split = rows.split;
    const float same_pixel_px = split.rule().same_pixel_px;
    const std::size_t i = std::size_t(y) * std::size_t(samples.width) + std::size_t(x);
    const std::size_t first = samples.first[i];
    bool in_block = false;
    float shown = 0;  // light taken so far
    for (std::size_t k = first; k < samples.first[i + 1]; ++k) {
        CocSample& sample = samples.samples[k];
        if (split.is_dim(luminance(sample.colour), sample.colour.a)) continue;
        const Rgba base = split.base(x, rows.first_row + y, sample.coc_px, sample.colour);
        if (base == sample.colour) continue;
        const auto up_to_this = std::span(samples.samples).subspan(first, k + 1 - first);
        const Rgba taken = sample.colour - base;
        const bool is_flat = split.is_flat(x, rows.first_row + y), is_deep = same_pixel_px > 0 && !is_flat;
        const bool is_shown = !is_deep && is_beside(up_to_this) &&
                              shown + luminance(taken) <= split.shown(x, rows.first_row + y);
        float leaves = 1;
        if (is_deep)
            leaves = share_that_leaves(up_to_this, same_pixel_px);
        else if (split.rule().hidden_known && !is_flat)
            leaves = not_covered(up_to_this);
        if (leaves <= 0) continue;  // what covers it hides it in the base
        shown += luminance(taken);
        const float coc = std::clamp(split.radius_of_light(x, rows.first_row + y, sample.coc_px),
                                     -kWidestHighlightPx, kWidestHighlightPx);
        const PartOfPixel part = split.part_of_lamp(x, rows.first_row + y);
        sample.colour = base;
        if (in_block) {
            out.push_back({x, y, 1, coc, leaves * taken, part, is_shown});
            continue;
        }
        if (!block) block.emplace(x - x % kLargestSquare, y - y % kLargestSquare, rows.first_row);
        block->put(x, y, coc, {taken, k, leaves, part, is_shown}), in_block = true;
    }
}

// Takes the light of the block of pixels whose first is (x0, y0).
void take_block(const Rows& rows, int x0, int y0, int largest_square, std::vector<Highlight>& out) {
    const int right = std::min(rows.samples.width, x0 + kLargestSquare);
    const int bottom = std::min(rows.samples.height(), y0 + kLargestSquare);
    std::optional<Block> block;  // made where there is light to be taken
    for (int y = y0; y < bottom; ++y)
        for (int x = x0; x < right; ++x) take_pixel(rows, x, y, block, out);
    if (!block) return;
    for (int size = largest_square; size > 1; size /= 2) block->take_squares(size, rows.split, out);
    block->finish(rows.split, rows.samples, out);
}

}  // namespace

std::vector<Highlight> take_highlights(CocSamples& samples, const HighlightSplit& split, int first_row,
                                       int largest_square, Workers& workers) {
    const Rows rows{samples, split, first_row};
    const int bands = (samples.height() + kLargestSquare - 1) / kLargestSquare;
    std::vector<std::vector<Highlight>> found(static_cast<std::size_t>(bands));
    parallel_for(bands, workers, [&](int band) {
        for (int x0 = 0; x0 < samples.width; x0 += kLargestSquare)
            take_block(rows, x0, band * kLargestSquare, largest_square, found[std::size_t(band)]);
    });
    std::vector<Highlight> highlights;
    for (const auto& band : found) highlights.insert(highlights.end(), band.begin(), band.end());
    return highlights;
}

}  // namespace petzval::engine
