#include "engine/sprites/sprites_draw.h"

#include "base/parallel.h"
#include "engine/sprites/sprites_dimmer.h"
#include "engine/sprites/sprites_kernels.h"
#include "engine/sprites/sprites_shadow.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

constexpr int kTile = 256;
constexpr int kBorder = 1;  // cells around a tile that enlarging reads

// A light as it is drawn.
struct Drawing {
    std::uint64_t order = 0;  // level, kernel
    int x = 0, y = 0;         // cell
    Rgba light;
    PupilMask mask;
    int level() const { return int(order >> 32); }
    int kernel() const { return int(order & 0xffffffff); }
};

Rect cells_of(const Rect& tile, int level) {
    if (level == 0) return tile;
    return Rect{tile.x0 >> level, tile.y0 >> level, ((tile.x1 - 1) >> level) + 1,
                ((tile.y1 - 1) >> level) + 1}
        .grown(kBorder);
}

// Runs work(begin, end) for pieces of 0…count.
template <typename Work>
void in_batches(std::size_t count, std::size_t batch, Workers& workers, const Work& work) {
    parallel_for(int((count + batch - 1) / batch), workers, [&](int i) {
        const std::size_t begin = std::size_t(i) * batch;
        work(begin, std::min(count, begin + batch));
    });
}

// Numbers of the sprites, neighbours after each other: they ask for the same part of the picture.
std::vector<std::uint32_t> by_place(const Input& input, std::span<const Sprite> sprites) {
    constexpr float kCell = 32;
    const int columns = 1 + int(float(input.width()) / kCell), rows = 1 + int(float(input.height()) / kCell);
    const auto cell = [&](const Sprite& s) {
        return std::size_t(int(std::clamp(s.y / kCell, 0.0f, float(rows - 1))) * columns +
                           int(std::clamp(s.x / kCell, 0.0f, float(columns - 1))));
    };
    std::vector<std::uint32_t> next(std::size_t(columns * rows) + 1, 0), order(sprites.size());
    for (const Sprite& s : sprites) ++next[cell(s) + 1];
    for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    for (std::size_t i = 0; i < sprites.size(); ++i) order[next[cell(sprites[i])]++] = std::uint32_t(i);
    return order;
}

// Lights that anything is seen of, as drawings, by the tiles they may reach.
class Buckets {
public:
    Buckets(const Input& input, std::span<const Sprite> sprites, const SpriteKernels& kernels)
        : in_(input),
          kernels_(kernels),
          tiles_x_((input.width() + kTile - 1) / kTile),
          tiles_y_((input.height() + kTile - 1) / kTile) {
        std::vector<Placed> placed(sprites.size());
        const SpriteShadows shadows(input);
        const std::vector<std::uint32_t> order = by_place(input, sprites);
        in_batches(sprites.size(), 4096, *input.workers, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !input.progress->cancelled(); ++i)
                placed[i] = place(sprites[order[i]], shadows);
        });
        sort_into_tiles(placed);
    }
    int count() const { return tiles_x_ * tiles_y_; }
    Rect area(int tile, const Rect& picture) const {
        const int x = tile % tiles_x_ * kTile, y = tile / tiles_x_ * kTile;
        return Rect{x, y, x + kTile, y + kTile}.intersected(picture);
    }
    std::span<Drawing> at(int tile) {
        const std::size_t i = std::size_t(tile);
        return std::span(members_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

private:
    struct Placed {
        Drawing drawing;
        short x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // tiles
    };

    Placed place(const Sprite& s, const SpriteShadows& shadows) const {
        Placed placed;
        placed.drawing.mask = shadows.mask(s.x, s.y, s.coc_px);
        if (placed.drawing.mask.is_closed()) return placed;
        const Stamping where = kernels_.stamping(s.x, s.y, s.coc_px);
        placed.drawing.order = std::uint64_t(where.level) << 32 | std::uint64_t(where.kernel);
        placed.drawing.x = where.x, placed.drawing.y = where.y;
        placed.drawing.light = {s.r, s.g, s.b, 0};
        const float reach = where.level > 0 ? float(kernels_.reach(where.level) + 2) * float(1 << where.level)
                                            : std::max(1.0f, per_px_) * std::abs(s.coc_px) * 1.02f + 4;
        const auto tile = [](float at, int tiles) {
            return short(std::clamp(std::floor(at / kTile), 0.0f, float(tiles)));
        };
        placed.x0 = tile(s.x - reach, tiles_x_), placed.x1 = tile(s.x + reach + kTile, tiles_x_);
        placed.y0 = tile(s.y - reach, tiles_y_), placed.y1 = tile(s.y + reach + kTile, tiles_y_);
        return placed;
    }

    // Counted first, piece by piece, so that pieces can be written in parallel and in order.
    void sort_into_tiles(const std::vector<Placed>& placed) {
        constexpr std::size_t kPiece = 1 << 16;
        const std::size_t tiles = std::size_t(count()), pieces = (placed.size() + kPiece - 1) / kPiece;
        std::vector<std::size_t> next(tiles * pieces);
        const auto each = [&](std::size_t begin, std::size_t end, const auto& visit) {
            for (std::size_t i = begin; i < end; ++i)
                for (int y = placed[i].y0; y < placed[i].y1; ++y)
                    for (int x = placed[i].x0; x < placed[i].x1; ++x)
                        visit(next[std::size_t(y * tiles_x_ + x) * pieces + begin / kPiece],
                              placed[i].drawing);
        };
        in_batches(placed.size(), kPiece, *in_.workers, [&](std::size_t begin, std::size_t end) {
            each(begin, end, [](std::size_t& n, const Drawing&) { ++n; });
        });
        std::size_t sum = 0;
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            first_.push_back(sum);
            for (std::size_t piece = 0; piece < pieces; ++piece)
                sum += std::exchange(next[tile * pieces + piece], sum);
        }
        first_.push_back(sum);
        members_.resize(sum);
        in_batches(placed.size(), kPiece, *in_.workers, [&](std::size_t begin, std::size_t end) {
            each(begin, end, [&](std::size_t& n, const Drawing& drawing) { members_[n++] = drawing; });
        });
    }

    const Input& in_;
    const SpriteKernels& kernels_;
    int tiles_x_, tiles_y_;
    float per_px_ = float(in_.lens(0).reach_px(1000) / 1000);  // of a radius, roughly
    std::vector<std::size_t> first_;
    std::vector<Drawing> members_;
};

class Drawer {
public:
    Drawer(const Input& input, const SpriteKernels& kernels) : in_(input), kernels_(kernels) {}

    void draw(std::span<Drawing> members, const Rect& tile, View<Rgba> out) const {
        if (members.empty()) return;
        const std::vector<const Drawing*> drawings = sorted(members);
        Accumulator cells;
        Dimmer dimmer;
        for (std::size_t i = 0; i < drawings.size();) {
            const int level = drawings[i]->level();
            cells.reset(cells_of(tile, level));
            while (i < drawings.size() && drawings[i]->level() == level)
                i = draw_kernel(drawings, i, dimmer, cells);
            add(cells, level, tile, out);
        }
    }

private:
    // All drawings from `begin` on that share its kernel; returns the next.
    std::size_t draw_kernel(const std::vector<const Drawing*>& drawings, std::size_t begin, Dimmer& dimmer,
                            Accumulator& cells) const {
        const std::uint64_t order = drawings[begin]->order;
        const int number = drawings[begin]->kernel(), level = drawings[begin]->level();
        const StampKernel& kernel = kernels_.at(number);
        bool ready = false;
        std::size_t i = begin;
        for (; i < drawings.size() && drawings[i]->order == order; ++i) {
            const Drawing& d = *drawings[i];
            if (d.light == Rgba{}) continue;
            if (d.mask.is_open()) {
                stamp({&kernel, 1}, d.x, d.y, d.light, 0, 0, {&cells, 1});
                continue;
            }
            if (!ready)
                dimmer.use(kernel, kernels_.radius_px(number) / float(1 << level), float(in_.pixel_aspect));
            ready = true;
            stamp_dimmed(kernel, d.x, d.y, d.light, dimmer.rows(d.mask), cells);
        }
        return i;
    }

    // By level and kernel, so that each kernel is at hand while it is used, then row by row; lights on one
    // spot as one.
    static std::vector<const Drawing*> sorted(std::span<Drawing> members) {
        struct Key {
            std::uint64_t order, place;
            Drawing* drawing;
            bool operator<(const Key& b) const {
                return std::tie(order, place, drawing) < std::tie(b.order, b.place, b.drawing);
            }
        };
        std::vector<Key> keys;
        keys.reserve(members.size());
        constexpr std::uint32_t kSign = 0x80000000;  // numbers below 0 come first
        for (Drawing& d : members)
            keys.push_back({d.order,
                            std::uint64_t(std::uint32_t(d.y) ^ kSign) << 32 | (std::uint32_t(d.x) ^ kSign),
                            &d});
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            Drawing &a = *keys[i].drawing, &b = *keys[i + 1].drawing;
            if (keys[i].order != keys[i + 1].order || keys[i].place != keys[i + 1].place ||
                !a.mask.is_open() || !b.mask.is_open())
                continue;
            b.light += a.light;
            a.light = {};
        }
        std::vector<const Drawing*> drawings;
        drawings.reserve(keys.size());
        for (const Key& key : keys) drawings.push_back(key.drawing);
        return drawings;
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
    const SpriteKernels& kernels_;
};

}  // namespace

void draw_sprites(const Input& input, std::span<const Sprite> sprites, View<Rgba> out) {
    if (sprites.empty()) return;
    const SpriteKernels kernels(input, sprites);
    Buckets buckets(input, sprites, kernels);
    const Drawer drawer(input, kernels);
    parallel_for(buckets.count(), *input.workers, [&](int tile) {
        if (input.progress->cancelled()) return;
        drawer.draw(buckets.at(tile), buckets.area(tile, out.rect()), out);
    });
}

}  // namespace petzval::engine
