#include "engine/lights/sprites_plan.h"

#include "base/parallel.h"
#include "engine/lights/pupil_masks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace petzval::engine {
namespace {

constexpr int kTile = 256;

// Runs work(begin, end) for pieces of 0…count.
template <typename Work>
void in_batches(std::size_t count, std::size_t batch, Workers& workers, const Work& work) {
    parallel_for(int((count + batch - 1) / batch), workers, [&](int i) {
        const std::size_t begin = std::size_t(i) * batch;
        work(begin, std::min(count, begin + batch));
    });
}

// Numbers of the sprites, neighbours after each other: they ask for the same part of the picture.
std::vector<std::uint32_t> by_place(const EngineView& input, std::span<const Sprite> sprites) {
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

class SpritesPlanner {
public:
    SpritesPlanner(const EngineView& input, const SpriteGrid& grid)
        : in_(input),
          grid_(grid),
          tiles_x_((input.width() + kTile - 1) / kTile),
          tiles_y_((input.height() + kTile - 1) / kTile) {
        plan_.rows = input.samples.colour.rect();
        plan_.stretch = float(input.lens.pixel_aspect);
    }

    LightsPlan plan(std::span<const Sprite> sprites) {
        plan_.lights.resize(sprites.size()), plan_.masks.resize(sprites.size());
        reached_.resize(sprites.size());
        const PupilMasks shadows(in_);
        const std::vector<std::uint32_t> order = by_place(in_, sprites);
        in_batches(sprites.size(), 4096, *in_.services.workers, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end && !in_.services.progress->cancelled(); ++i)
                place(sprites[order[i]], shadows, i);
        });
        ask_for_kernels();
        sort_into_tiles();
        parallel_for(tiles_x_ * tiles_y_, *in_.services.workers, [&](int tile) { sort_by_kernel(tile); });
        return std::move(plan_);
    }

private:
    // Tiles that a light may reach.
    struct Reached {
        short x0 = 0, y0 = 0, x1 = 0, y1 = 0;
        bool empty() const { return x0 >= x1 || y0 >= y1; }
    };

    // Its kernel is that of the grid as yet.
    void place(const Sprite& s, const PupilMasks& shadows, std::size_t i) {
        const PupilMask mask = plan_.masks[i] = shadows.mask(s.x, s.y, s.coc_px);
        if (mask.is_closed()) return;
        const SpriteGrid::Place where = grid_.place(s.x, s.y, s.coc_px);
        plan_.lights[i] = {{where.x, where.y, 1, s.coc_px, {s.r, s.g, s.b, 0}},
                           std::uint32_t(i),
                           std::uint32_t(where.kernel)};
        const float reach = grid_.reach_px(where.level, s.coc_px);
        const auto tile = [](float at, int tiles) {
            return short(std::clamp(std::floor(at / kTile), 0.0f, float(tiles)));
        };
        reached_[i] = {tile(s.x - reach, tiles_x_), tile(s.y - reach, tiles_y_),
                       tile(s.x + reach + kTile, tiles_x_), tile(s.y + reach + kTile, tiles_y_)};
    }

    void ask_for_kernels() {
        std::vector<std::uint32_t> places(grid_.count());
        for (std::size_t i = 0; i < reached_.size(); ++i)
            if (!reached_[i].empty()) places[plan_.lights[i].kernel] = 1;
        struct Asked {
            device::KernelAsk ask;
            std::size_t kernel;
        };
        std::vector<Asked> asked;
        for (std::size_t k = 0; k < places.size(); ++k)
            if (places[k]) asked.push_back({grid_.ask(k), k});
        std::sort(asked.begin(), asked.end(), [](const Asked& a, const Asked& b) { return a.ask < b.ask; });
        for (const Asked& a : asked) {
            places[a.kernel] = std::uint32_t(plan_.kernels.asks.size());
            plan_.kernels.asks.push_back(a.ask);
        }
        for (std::size_t i = 0; i < reached_.size(); ++i) {
            if (reached_[i].empty()) continue;
            PlannedLight& light = plan_.lights[i];
            light.kernel = places[light.kernel];
            light.highlight.coc_px = SpriteGrid::radius_px(plan_.kernels.asks[light.kernel]);
        }
    }

    // Counted first, piece by piece, so that pieces can be written in parallel and in order.
    void sort_into_tiles() {
        constexpr std::size_t kPiece = 1 << 16;
        const std::size_t tiles = std::size_t(tiles_x_ * tiles_y_),
                          pieces = (reached_.size() + kPiece - 1) / kPiece;
        std::vector<std::size_t> next(tiles * pieces);
        const auto each = [&](const auto& visit) {
            in_batches(
                reached_.size(), kPiece, *in_.services.workers, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                        for (int y = reached_[i].y0; y < reached_[i].y1; ++y)
                            for (int x = reached_[i].x0; x < reached_[i].x1; ++x)
                                visit(next[std::size_t(y * tiles_x_ + x) * pieces + begin / kPiece], i);
                });
        };
        each([](std::size_t& n, std::size_t) { ++n; });
        std::size_t sum = 0;
        for (std::size_t tile = 0; tile < tiles; ++tile) {
            const int x = int(tile) % tiles_x_ * kTile, y = int(tile) / tiles_x_ * kTile;
            plan_.tiles.push_back({Rect{x, y, x + kTile, y + kTile}.intersected(plan_.rows), sum});
            for (std::size_t piece = 0; piece < pieces; ++piece)
                sum += std::exchange(next[tile * pieces + piece], sum);
        }
        plan_.tiles.push_back({{}, sum});
        plan_.order.resize(sum);
        each([&](std::size_t& n, std::size_t i) { plan_.order[n++] = std::uint32_t(i); });
    }

    // Sorts by kernel, so that each is used while cached; then by row.
    void sort_by_kernel(int tile) {
        struct Key {
            std::uint32_t kernel;
            int y, x;
            std::uint32_t light;
            bool operator<(const Key& b) const {
                return std::tie(kernel, y, x, light) < std::tie(b.kernel, b.y, b.x, b.light);
            }
        };
        const std::size_t begin = plan_.tiles[std::size_t(tile)].first_light,
                          end = plan_.tiles[std::size_t(tile) + 1].first_light;
        std::vector<Key> keys;
        keys.reserve(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            const PlannedLight& light = plan_.lights[plan_.order[i]];
            keys.push_back({light.kernel, light.highlight.y, light.highlight.x, plan_.order[i]});
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = begin; i < end; ++i) plan_.order[i] = keys[i - begin].light;
    }

    const EngineView& in_;
    const SpriteGrid& grid_;
    int tiles_x_, tiles_y_;
    LightsPlan plan_;
    std::vector<Reached> reached_;  // by light
};

}  // namespace

LightsPlan plan_sprites(const EngineView& input, std::span<const Sprite> sprites, const SpriteGrid& grid) {
    return SpritesPlanner(input, grid).plan(sprites);
}

}  // namespace petzval::engine
