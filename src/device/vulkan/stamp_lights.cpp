#include "device/vulkan/stamp_lights.h"

#include "device/vulkan/add_lights.h"
#include "device/vulkan/canvas.h"
#include "device/vulkan/words.h"
#include "engine/waist/cells.h"
#include "laws/tiles.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using engine::LightsPlan;
using engine::PlannedLight;
using engine::PupilMask;

constexpr int kTile = laws::kStampedTile;
constexpr std::size_t kTilePixels = std::size_t(kTile) * kTile;
constexpr int kBlock = laws::kStampedBlock;  // cells of a level, along a side
constexpr std::size_t kBlockCells = std::size_t(kBlock) * kBlock;
constexpr std::uint32_t kGroupsPerBlock = kBlockCells / laws::kGroup,
                        kGroupsPerTile = kTilePixels / laws::kGroup;
constexpr int kBorder = laws::kStampedBorder;

// Lights begin…end - 1 of a tile, in the plan's order.
struct TilePart {
    std::size_t tile, begin, end;
};

// The next light to be drawn: a tile, a place in the order.
struct Place {
    std::size_t tile = 0, at = 0;
};

// Blocks of cells, and the lights that touch each.
struct Blocks {
    std::vector<Rect> cells;
    std::vector<std::vector<std::uint32_t>> lights;  // by block: places in the list of lights
};

class Stamper {
public:
    Stamper(Context& context, const LightsPlan& plan, const PackedAtlas& atlas, const StampRule& rule)
        : context_(context), plan_(plan), atlas_(atlas), rule_(rule) {}

    // The next parts to draw together; advances `place`. Empty: none are left.
    std::vector<TilePart> next(Place& place) const {
        std::vector<TilePart> parts;
        std::size_t lights = 0, bytes = 0;
        std::uint64_t taps = 0;
        std::set<std::uint32_t> kernels;
        const std::size_t most_tiles = context_.at_once(rule_.most_tiles),
                          most_lights = context_.at_once(rule_.most_lights),
                          most_bytes = context_.at_once(rule_.most_weight_bytes);
        for (; place.tile + 1 < plan_.tiles.size() && parts.size() < most_tiles; ++place.tile) {
            const std::size_t end = plan_.tiles[place.tile + 1].first_light;
            place.at = std::max(place.at, plan_.tiles[place.tile].first_light);
            TilePart part{place.tile, place.at, place.at};
            for (bool is_full = false; part.end < end; ++part.end, ++lights) {
                const PackedSet& kernel = atlas_[light(part.end).kernel];
                const bool is_new = !kernels.contains(light(part.end).kernel);
                const std::size_t more = is_new ? kernel.weights.size() * sizeof(float) : 0;
                is_full = lights > 0 && (lights >= most_lights || bytes + more > most_bytes ||
                                         4 * (taps + kernel.taps) > rule_.most_multiply_adds);
                if (is_full) break;
                kernels.insert(light(part.end).kernel);
                bytes += more, taps += kernel.taps;
            }
            place.at = part.end;
            if (part.begin < part.end) parts.push_back(part);
            if (part.end < end) break;
        }
        return parts;
    }

    // Returns the taps drawn.
    std::uint64_t draw(const std::vector<TilePart>& parts, Target out) {
        words_.clear(), lights_.clear(), blocks_ = {}, taps_ = 0;
        const std::uint32_t levels = list_tiles(parts);
        LightsPush push;
        push.stretch = plan_.stretch;
        list_blocks(push);
        Recording recording(context_);
        const Piece words = recording.uploaded(std::span<const std::uint32_t>(words_));
        const KernelsOnDevice kernels = uploaded_kernels(parts, recording);
        push.records = kernels.records;
        const Piece cells =
            context_.heap().allocate(Kind::OnDevice, blocks_.cells.size() * kBlockCells * sizeof(Rgba));
        recording.pass(
            "stamp lights", context_.program(Shader::AddLights, kMasked),
            {&words, &kernels.words, &kernels.weights, &words, &words, &cells}, push,
            {std::uint32_t(blocks_.cells.size()) * kGroupsPerBlock},
            {words_.size() * sizeof(std::uint32_t) + blocks_.cells.size() * kBlockCells * sizeof(Rgba),
             4 * taps_});
        const std::size_t bytes = parts.size() * kTilePixels * sizeof(Rgba);
        const Piece result = context_.heap().allocate(Kind::OnDevice, bytes);
        const std::uint32_t told[] = {0, levels};
        recording.pass("add cells", context_.program(Shader::AddCells), {&words, &cells, &result}, told,
                       {kGroupsPerTile, std::uint32_t(parts.size())});
        std::vector<Rect> places;
        for (const TilePart& part : parts)
            places.push_back(plan_.tiles[part.tile].pixels.moved(0, plan_.first_row));
        Delivery delivery(context_, out);
        delivery.squares(recording, result, places, kTile, true);
        recording.run();
        delivery.finish();
        return taps_;
    }

private:
    static constexpr std::uint32_t kMasked = 2;

    const PlannedLight& light(std::size_t i) const { return plan_.lights[plan_.order[i]]; }
    int level_of(std::size_t i) const { return plan_.kernels.asks[light(i).kernel].level; }
    const PupilMask& mask(std::size_t i) const { return plan_.masks[light(i).viewpoint]; }
    // True if the next light has the same kernel and position.
    bool is_same_as_next(std::size_t i, std::size_t end) const {
        if (i + 1 == end || !mask(i).is_open() || !mask(i + 1).is_open()) return false;
        const PlannedLight &a = light(i), &b = light(i + 1);
        return a.kernel == b.kernel && a.highlight.x == b.highlight.x && a.highlight.y == b.highlight.y;
    }

    // Tiles and their levels, and the lights of each level by block; returns where levels begin.
    std::uint32_t list_tiles(const std::vector<TilePart>& parts) {
        std::vector<std::uint32_t> levels;
        constexpr std::size_t kLevelWords = 5;
        const auto add_tile = [&](const Rect& r) { add_rect(words_, r, levels.size() / kLevelWords); };
        for (const TilePart& part : parts) {
            add_tile(plan_.tiles[part.tile].pixels);
            for (std::size_t i = part.begin; i < part.end;) {
                const int level = level_of(i);
                const Rect cells = engine::cells_of(plan_.tiles[part.tile].pixels, level, kBorder);
                const int across = (cells.width() + kBlock - 1) / kBlock;
                levels.insert(levels.end(),
                              {std::uint32_t(level), std::uint32_t(cells.x0), std::uint32_t(cells.y0),
                               std::uint32_t(across), std::uint32_t(blocks_.cells.size())});
                i = list_level(i, part.end, cells, across);
            }
        }
        add_tile({});
        const auto begin = std::uint32_t(words_.size());
        words_.insert(words_.end(), levels.begin(), levels.end());
        return begin;
    }

    // The lights of one level from `begin` on; returns the first of the next.
    std::size_t list_level(std::size_t begin, std::size_t end, const Rect& cells, int across) {
        const std::size_t first_block = blocks_.cells.size();
        for (int y = cells.y0; y < cells.y1; y += kBlock)
            for (int x = cells.x0; x < cells.x1; x += kBlock)
                blocks_.cells.push_back(Rect{x, y, x + kBlock, y + kBlock}.intersected(cells));
        blocks_.lights.resize(blocks_.cells.size());
        const int level = level_of(begin);
        std::size_t i = begin;
        for (; i < end && level_of(i) == level; ++i) {
            Rgba sum = light(i).highlight.colour;
            taps_ += atlas_[light(i).kernel].taps;
            for (; is_same_as_next(i, end); ++i) sum += light(i + 1).highlight.colour;
            const engine::Highlight& h = light(i).highlight;
            const Rect reached =
                atlas_[light(i).kernel].kernels.front().extent.moved(h.x, h.y).intersected(cells);
            if (reached.empty()) continue;
            for (int y = (reached.y0 - cells.y0) / kBlock; y <= (reached.y1 - 1 - cells.y0) / kBlock; ++y)
                for (int x = (reached.x0 - cells.x0) / kBlock; x <= (reached.x1 - 1 - cells.x0) / kBlock; ++x)
                    blocks_.lights[first_block + std::size_t(y * across + x)].push_back(
                        std::uint32_t(lights_.size() / kLightWords));
            const std::uint64_t seen = mask(i).seen;
            add_light(lights_, light(i), sum, std::ldexp(h.coc_px, -level), std::uint32_t(seen),
                      std::uint32_t(seen >> 32));
        }
        return i;
    }

    void list_blocks(LightsPush& push) {
        push.tiles = std::uint32_t(words_.size());
        std::vector<std::uint32_t> order;
        for (std::size_t b = 0; b < blocks_.cells.size(); ++b) {
            add_rect(words_, blocks_.cells[b], order.size());
            order.insert(order.end(), blocks_.lights[b].begin(), blocks_.lights[b].end());
        }
        add_rect(words_, {}, order.size());
        push.order = std::uint32_t(words_.size());
        words_.insert(words_.end(), order.begin(), order.end());
        push.lights = std::uint32_t(words_.size());
        words_.insert(words_.end(), lights_.begin(), lights_.end());
    }

    KernelsOnDevice uploaded_kernels(const std::vector<TilePart>& parts, Recording& recording) const {
        std::set<std::uint32_t> kernels;
        for (const TilePart& part : parts)
            for (std::size_t i = part.begin; i < part.end; ++i) kernels.insert(light(i).kernel);
        return atlas_.uploaded(std::vector<std::uint32_t>(kernels.begin(), kernels.end()), recording);
    }

    Context& context_;
    const LightsPlan& plan_;
    const PackedAtlas& atlas_;
    const StampRule rule_;
    // Words and lights of the batch.
    std::vector<std::uint32_t> words_, lights_;
    Blocks blocks_;
    std::uint64_t taps_ = 0;
};

}  // namespace

Work stamp_planned_lights(Context& context, const LightsPlan& plan, const PackedAtlas& atlas, Target out,
                          const Control& control, const StampRule& rule) {
    Stamper stamper(context, plan, atlas, rule);
    std::uint64_t taps = 0;
    for (Place place; !control.progress.cancelled();) {
        Place end = place;
        const std::vector<TilePart> parts = stamper.next(end);
        if (parts.empty()) break;
        try {
            taps += stamper.draw(parts, out);
            place = end;
        } catch (const Failed& failed) {
            if (!context.halves(failed)) throw;
        }
    }
    return Work::of_taps(taps);
}

}  // namespace petzval::device::vulkan
