#include "engine/sprites_draw.h"

#include "base/parallel.h"
#include "engine/sprites_kernels.h"
#include "engine/sprites_shadow.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace petzval::engine {
namespace {

constexpr int kTile = 256;
constexpr int kBorder = 1;  // cells around a tile that enlarging reads

struct Drawing {
    std::uint64_t order;  // level, kernel
    int x, y;             // cell
    Rgba light;
    std::uint32_t sprite;
};

Rect cells_of(const Rect& tile, int level) {
    if (level == 0) return tile;
    return Rect{tile.x0 >> level, tile.y0 >> level, ((tile.x1 - 1) >> level) + 1,
                ((tile.y1 - 1) >> level) + 1}
        .grown(kBorder);
}

// Which sprites may reach which tile.
class Buckets {
public:
    Buckets(const Input& input, std::span<const Sprite> sprites, const SpriteKernels& kernels)
        : tiles_x_((input.width() + kTile - 1) / kTile), tiles_y_((input.height() + kTile - 1) / kTile) {
        first_.assign(std::size_t(tiles_x_ * tiles_y_) + 1, 0);
        each(input, sprites, kernels, [&](int tile, std::uint32_t) { ++first_[std::size_t(tile) + 1]; });
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
        members_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        each(input, sprites, kernels,
             [&](int tile, std::uint32_t sprite) { members_[next[std::size_t(tile)]++] = sprite; });
    }
    int count() const { return tiles_x_ * tiles_y_; }
    Rect area(int tile, const Rect& picture) const {
        const int x = tile % tiles_x_ * kTile, y = tile / tiles_x_ * kTile;
        return Rect{x, y, x + kTile, y + kTile}.intersected(picture);
    }
    std::span<const std::uint32_t> at(int tile) const {
        const std::size_t i = std::size_t(tile);
        return std::span(members_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

private:
    template <typename Visit>
    void each(const Input& input, std::span<const Sprite> sprites, const SpriteKernels& kernels,
              const Visit& visit) const {
        const float per_px = float(input.lens(0).reach_px(1000) / 1000);  // of a radius, roughly
        for (std::size_t i = 0; i < sprites.size(); ++i) {
            const Sprite& s = sprites[i];
            const Stamping where = kernels.stamping(s.x, s.y, s.coc_px);
            const float reach = where.level > 0
                                    ? float(kernels.reach(where.level) + 2) * float(1 << where.level)
                                    : std::max(1.0f, per_px) * std::abs(s.coc_px) * 1.02f + 4;
            const auto tile = [](float at, int tiles) {
                return std::clamp(int(std::floor(std::clamp(at, -1e6f, 1e6f) / kTile)), -1, tiles);
            };
            const int x0 = std::max(0, tile(s.x - reach, tiles_x_)), x1 = tile(s.x + reach, tiles_x_);
            const int y0 = std::max(0, tile(s.y - reach, tiles_y_)), y1 = tile(s.y + reach, tiles_y_);
            for (int y = y0; y <= std::min(y1, tiles_y_ - 1); ++y)
                for (int x = x0; x <= std::min(x1, tiles_x_ - 1); ++x)
                    visit(y * tiles_x_ + x, std::uint32_t(i));
        }
    }

    int tiles_x_, tiles_y_;
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> members_;
};

class Drawer {
public:
    Drawer(const Input& input, std::span<const Sprite> sprites, const SpriteKernels& kernels)
        : in_(input), sprites_(sprites), kernels_(kernels), shadows_(input), masks_(sprites.size()) {
        constexpr std::size_t kBatch = 4096;
        parallel_for(int((sprites.size() + kBatch - 1) / kBatch), input.threads, [&](int batch) {
            const std::size_t begin = std::size_t(batch) * kBatch,
                              end = std::min(sprites.size(), begin + kBatch);
            for (std::size_t i = begin; i < end && !input.progress->cancelled(); ++i)
                masks_[i] = shadows_.mask(sprites[i].x, sprites[i].y, sprites[i].coc_px);
        });
    }

    void draw(std::span<const std::uint32_t> members, const Rect& tile, View<Rgba> out) const {
        if (members.empty()) return;
        std::vector<Drawing> drawings = sorted(members);
        Accumulator cells;
        for (std::size_t i = 0; i < drawings.size();) {
            const int level = int(drawings[i].order >> 48);
            cells.reset(cells_of(tile, level));
            for (; i < drawings.size() && int(drawings[i].order >> 48) == level; ++i)
                if (drawings[i].light != Rgba{}) draw_one(drawings[i], cells);
            add(cells, level, tile, out);
        }
    }

private:
    bool is_open(std::uint32_t sprite) const { return masks_[sprite].is_open(); }

    // By level and kernel, so that each kernel is at hand while it is used; lights on one spot as one.
    std::vector<Drawing> sorted(std::span<const std::uint32_t> members) const {
        std::vector<Drawing> drawings;
        drawings.reserve(members.size());
        for (const std::uint32_t i : members) {
            const Sprite& s = sprites_[i];
            const Stamping w = kernels_.stamping(s.x, s.y, s.coc_px);
            const std::uint64_t order = std::uint64_t(w.level) << 48 | std::uint64_t(w.kernel);
            drawings.push_back({order, w.x, w.y, {s.r, s.g, s.b, 0}, i});
        }
        const auto key = [](const Drawing& d) { return std::tuple(d.order, d.y, d.x, d.sprite); };
        std::sort(drawings.begin(), drawings.end(),
                  [&](const Drawing& a, const Drawing& b) { return key(a) < key(b); });
        for (std::size_t i = 0; i + 1 < drawings.size(); ++i) {
            Drawing &a = drawings[i], &b = drawings[i + 1];
            if (a.order != b.order || a.x != b.x || a.y != b.y || !is_open(a.sprite) || !is_open(b.sprite))
                continue;
            b.light += a.light;
            a.light = {};
        }
        return drawings;
    }

    void draw_one(const Drawing& d, Accumulator& cells) const {
        const int kernel = int(d.order & 0xffffffff);
        if (is_open(d.sprite)) {
            stamp(kernels_.at(kernel), d.x, d.y, d.light, 0, 0, cells);
            return;
        }
        draw_masked(kernels_.at(kernel), d, cells);
    }

    // Each weight dimmed by the share of its place in the pupil.
    void draw_masked(const StampKernel& kernel, const Drawing& d, Accumulator& cells) const {
        const PupilMask& mask = masks_[d.sprite];
        if (mask.is_closed()) return;
        const float radius = sprites_[d.sprite].coc_px / float(1 << int(d.order >> 48));
        const float per_cell = 1 / std::copysign(std::max(std::abs(radius), 0.5f), radius);
        const Rect e = kernel.extent(), area = cells.area();
        const int x0 = std::max(e.x0, area.x0 - d.x), x1 = std::min(e.x1, area.x1 - d.x);
        for (int y = std::max(e.y0, area.y0 - d.y); y < std::min(e.y1, area.y1 - d.y); ++y) {
            const auto shares = mask.row(float(y) * per_cell / float(in_.pixel_aspect));
            const float* weights = kernel.row(y - e.y0);
            Rgba* to = cells.row(d.y + y) - area.x0;
            for (int x = x0; x < x1; ++x) {
                const float* w = weights + std::ptrdiff_t(4) * (x - e.x0);
                const float share = PupilMask::at(shares, float(x) * per_cell);
                to[d.x + x] += share * (Rgba{w[0], w[1], w[2], w[3]} * d.light);
            }
        }
    }

    // Between the cells of coarser levels bilinear, which keeps their light.
    static void add(const Accumulator& cells, int level, const Rect& tile, View<Rgba> out) {
        const float per_cell = 1 / float(1 << level);
        const float per_pixel = per_cell * per_cell;
        for (int y = tile.y0; y < tile.y1; ++y) {
            Rgba* to = out.row(y);
            if (level == 0) {
                const Rgba* from = cells.row(y) - tile.x0;
                for (int x = tile.x0; x < tile.x1; ++x) to[x] += from[x];
                continue;
            }
            const float at_y = (float(y) + 0.5f) * per_cell - 0.5f;
            const int top = int(std::floor(at_y));
            const float below = at_y - float(top);
            const Rgba *a = cells.row(top) - cells.area().x0, *b = cells.row(top + 1) - cells.area().x0;
            for (int x = tile.x0; x < tile.x1; ++x) {
                const float at_x = (float(x) + 0.5f) * per_cell - 0.5f;
                const int left = int(std::floor(at_x));
                const float right = at_x - float(left);
                to[x] += per_pixel * ((1 - below) * ((1 - right) * a[left] + right * a[left + 1]) +
                                      below * ((1 - right) * b[left] + right * b[left + 1]));
            }
        }
    }

    const Input& in_;
    std::span<const Sprite> sprites_;
    const SpriteKernels& kernels_;
    SpriteShadows shadows_;
    std::vector<PupilMask> masks_;
};

}  // namespace

void draw_sprites(const Input& input, std::span<const Sprite> sprites, View<Rgba> out) {
    if (sprites.empty()) return;
    float largest = 0;
    for (const Sprite& s : sprites) largest = std::max(largest, std::abs(s.coc_px));
    const SpriteKernels kernels(input, largest);
    const Buckets buckets(input, sprites, kernels);
    const Drawer drawer(input, sprites, kernels);
    parallel_for(buckets.count(), input.threads, [&](int tile) {
        if (input.progress->cancelled()) return;
        drawer.draw(buckets.at(tile), buckets.area(tile, out.rect()), out);
    });
}

}  // namespace petzval::engine
