#include "device/vulkan/gather.h"

#include "base/parallel.h"
#include "device/vulkan/canvas.h"
#include "device/vulkan/words.h"
#include "laws/tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using engine::CellLevel;
using engine::CellLight;
using engine::GatherPlan;

constexpr int kTile = GatherPlan::kTile;
constexpr std::size_t kTilePixels = std::size_t(kTile) * kTile;
constexpr std::uint32_t kGroupsPerTile = kTilePixels / laws::kGroup;
constexpr std::size_t kMostTiles = 16;  // of one submission

struct Push {
    std::uint32_t tiles = 0, levels = 0, turns = 0, places = 0;
    std::uint32_t turn_count = 0, ring_count = 0, records = 0, is_opaque = 0, open_edges = 0;
};
static_assert(sizeof(Push) == 36);

// Cells of one level in a window: their light by turn.
struct Cells {
    int width = 0, height = 0;  // of the level
    Rect window;
    std::vector<std::uint32_t> first;  // row by row, and the end
    std::vector<CellLight> lights;
};

class Gatherer {
public:
    Gatherer(Context& context, const GatherPlan& plan, const PackedAtlas& atlas, Workers& workers)
        : context_(context),
          plan_(plan),
          atlas_(atlas),
          workers_(workers),
          taps_(plan.tiles.size(), kUnknown) {
        for (int entry = 0; entry < plan.sizes.entries(); ++entry) {
            std::uint64_t taps = 0;
            int reach = 0;
            for (int zone = 0; zone < plan.zones.count(); ++zone) {
                const std::uint32_t kernel =
                    plan.kernel(plan.sizes.ring_of_entry(entry), zone, plan.sizes.is_skirt(entry));
                if (kernel >= atlas.size()) continue;
                if (taps == 0) taps = atlas[kernel].taps;
                for (const PackedSet::Kernel& k : atlas[kernel].kernels) {
                    const Rect& e = k.extent;
                    reach = std::max({reach, -e.x0, -e.y0, e.x1 - 1, e.y1 - 1});
                }
            }
            taps_of_entry_.push_back(taps), reach_of_entry_.push_back(reach);
        }
        upload_kernels();
    }

    // Tiles from `begin` on that are drawn at once: of one row, at most so many, of one kind.
    std::size_t end_of(std::size_t begin, std::size_t at_once) {
        const auto& tiles = plan_.tiles;
        const std::uint64_t most = context_.most_work("gather");
        std::uint64_t taps = 0;
        std::size_t end = begin;
        for (; end < tiles.size() && end - begin < at_once; ++end) {
            if (tiles[end].is_sharp != tiles[begin].is_sharp ||
                tiles[end].pixels.y0 != tiles[begin].pixels.y0)
                break;
            if (!tiles[end].is_sharp) taps += taps_of(end);
            if (kSums * taps > most && end > begin) break;
        }
        return end;
    }

    // Tiles begin…end - 1, which lie in one row.
    void draw(std::size_t begin, std::size_t end, Target out) {
        std::vector<Rect> tiles;
        std::uint64_t taps = 0;
        for (std::size_t t = begin; t < end; ++t) tiles.push_back(plan_.tiles[t].pixels), taps += taps_of(t);
        Push push;
        const std::vector<std::uint32_t> said = words_of(tiles, push);
        const std::uint64_t multiply_adds = kSums * taps;
        Recording recording(context_);
        const Piece words = recording.uploaded(std::span<const std::uint32_t>(said));
        push.records = kernels_.records;
        const std::size_t bytes = tiles.size() * kTilePixels * sizeof(Rgba);
        const Piece result = context_.heap().allocate(Kind::OnDevice, bytes);
        recording.pass("gather", context_.program(Shader::Gather),
                       {&words, &kernels_.words, &kernels_.weights, &result}, push,
                       {std::uint32_t(tiles.size()) * kGroupsPerTile},
                       {said.size() * sizeof(std::uint32_t) + atlas_.weight_bytes() + bytes, multiply_adds});
        context_.note_work("gather", multiply_adds, deliver(recording, result, tiles, out));
    }

    // Tiles begin…end - 1 as the picture has them.
    void copy(std::size_t begin, std::size_t end, Target out) const {
        std::vector<Rect> tiles;
        std::vector<Rgba> squares((end - begin) * kTilePixels);
        auto* to = squares.data();
        for (std::size_t t = begin; t < end; ++t, to += kTilePixels) {
            const Rect& tile = tiles.emplace_back(plan_.tiles[t].pixels);
            for (int y = 0; y < tile.height(); ++y)
                std::copy_n(plan_.strip.samples.colour.row(tile.y0 + y) + tile.x0, tile.width(),
                            to + std::ptrdiff_t(y) * kTile);
        }
        Recording recording(context_);
        deliver(recording, recording.uploaded(std::span<const Rgba>(squares)), tiles, out);
    }

private:
    static constexpr std::uint64_t kSums = 6;  // of a tap: colour, covered, beyond
    static constexpr std::uint64_t kUnknown = ~std::uint64_t(0);

    void upload_kernels() {
        std::vector<std::uint32_t> all(atlas_.size());
        std::iota(all.begin(), all.end(), 0u);
        Recording recording(context_);
        kernels_ = atlas_.uploaded(all, recording);
        recording.run();
    }

    // Runs what was recorded; returns the seconds that it took.
    double deliver(Recording& recording, const Piece& squares, std::vector<Rect> tiles, Target out) const {
        for (Rect& tile : tiles) tile = tile.moved(0, plan_.first_row);
        Delivery delivery(context_, out);
        delivery.squares(recording, squares, tiles, kTile);
        const double seconds = recording.run();
        delivery.finish();
        return seconds;
    }

    std::vector<std::uint32_t> words_of(const std::vector<Rect>& tiles, Push& push) const {
        std::vector<std::uint32_t> words;
        const auto here = [&] { return std::uint32_t(words.size()); };
        for (const Rect& r : tiles)
            words.insert(words.end(), {std::uint32_t(r.x0), std::uint32_t(r.y0), std::uint32_t(r.x1),
                                       std::uint32_t(r.y1)});
        push.places = here(), push.ring_count = 2 * std::uint32_t(plan_.sizes.count());
        words.insert(words.end(), plan_.places.begin(), plan_.places.end());
        push.levels = here();
        constexpr std::size_t kLevelWords = 9;
        words.resize(words.size() + std::size_t(plan_.sizes.levels()) * kLevelWords);
        std::vector<bool> has_light(std::size_t(plan_.sizes.entries()));
        for (int level = 0; level < plan_.sizes.levels(); ++level) {
            const Cells cells = cells_for(tiles, level);
            const std::uint32_t first = here();
            words.insert(words.end(), cells.first.begin(), cells.first.end());
            const std::uint32_t lights = here();
            for (const CellLight& l : cells.lights) {
                words.insert(words.end(), {bits_of(l.colour.r), bits_of(l.colour.g), bits_of(l.colour.b),
                                           bits_of(l.colour.a), bits_of(l.covered), bits_of(l.beyond),
                                           std::uint32_t(l.entry)});
                has_light[std::size_t(l.entry)] = true;
            }
            const auto middle = [&](int cell) { return std::ldexp(cell + 0.5, level) - 0.5; };
            const std::uint32_t columns = here();
            for (int x = cells.window.x0; x < cells.window.x1; ++x)
                words.push_back(std::uint32_t(plan_.zones.column_of(middle(x))));
            const std::uint32_t rows = here();
            for (int y = cells.window.y0; y < cells.window.y1; ++y)
                words.push_back(std::uint32_t(plan_.zones.row_of(middle(y)) * plan_.zones.columns));
            const std::array<std::uint32_t, kLevelWords> header{std::uint32_t(cells.width),
                                                                std::uint32_t(cells.height),
                                                                std::uint32_t(cells.window.x0),
                                                                std::uint32_t(cells.window.y0),
                                                                std::uint32_t(cells.window.width()),
                                                                first,
                                                                lights,
                                                                columns,
                                                                rows};
            std::copy(header.begin(), header.end(),
                      words.begin() + std::ptrdiff_t(push.levels + std::size_t(level) * kLevelWords));
        }
        push.turns = here();
        for (int turn = 0; turn < int(plan_.sizes.turns().size()); ++turn) {
            const auto [ring, hidden, is_seam] = plan_.sizes.turns()[std::size_t(turn)];
            const int skirt = plan_.sizes.skirt_entry(turn);
            const bool has_skirt = has_light[std::size_t(skirt)];
            if ((hidden || is_seam) && !has_light[std::size_t(turn)] && !has_skirt) continue;
            add_entry(turn, ring, plan_.sizes.level(ring), words);
            add_entry(skirt, plan_.sizes.count() + ring, has_skirt ? plan_.sizes.skirt_level(ring) : 0,
                      words);
            words.push_back(is_seam ? 1 : 0);
            ++push.turn_count;
        }
        const engine::OpenEdges& open = plan_.strip.window.open_edges;
        push.open_edges =
            (open.left ? 1u : 0u) | (open.top ? 2u : 0u) | (open.right ? 4u : 0u) | (open.bottom ? 8u : 0u);
        push.is_opaque = plan_.opaque ? 1 : 0;
        return words;
    }

    void add_entry(int entry, int place, int level, std::vector<std::uint32_t>& words) const {
        const int reach = std::min(reach_of_entry_[std::size_t(entry)], plan_.reach[std::size_t(level)]);
        words.insert(words.end(), {std::uint32_t(entry), std::uint32_t(place), std::uint32_t(level),
                                   std::uint32_t(reach)});
    }

    // Taps of the lights in a tile itself, each once; with the kernels of the first zone that has them.
    std::uint64_t taps_of(std::size_t tile) {
        std::uint64_t& taps = taps_[tile];
        if (taps != kUnknown) return taps;
        taps = 0;
        for (int level = 0; level < plan_.sizes.levels(); ++level)
            for (const CellLight& light :
                 cells_in(engine::cells_of(plan_.tiles[tile].pixels, level, 0), level).lights)
                taps += taps_of_entry_[std::size_t(light.entry)];
        return taps;
    }

    // All that the tiles may read.
    Cells cells_for(const std::vector<Rect>& tiles, int level) const {
        const Rect first = GatherPlan::cells_of(tiles.front(), level),
                   last = GatherPlan::cells_of(tiles.back(), level);
        return cells_in(Rect{first.x0, first.y0, last.x1, last.y1}.grown(plan_.reach[std::size_t(level)]),
                        level);
    }

    // Cells of a window that there are; beyond the picture, those at its edge.
    Cells cells_in(const Rect& window, int level) const {
        Cells cells;
        const CellLevel* const from = level > 0 ? &plan_.levels[std::size_t(level - 1)] : nullptr;
        cells.width = from ? from->width() : plan_.strip.width();
        cells.height = from ? from->height() : plan_.strip.height();
        Rect& w = cells.window;
        w.x0 = std::clamp(window.x0, 0, cells.width - 1), w.y0 = std::clamp(window.y0, 0, cells.height - 1);
        w.x1 = std::clamp(window.x1, w.x0 + 1, cells.width);
        w.y1 = std::clamp(window.y1, w.y0 + 1, cells.height);
        if (!from) return pixels(std::move(cells));
        for (int y = w.y0; y < w.y1; ++y)
            for (int x = w.x0; x < w.x1; ++x) {
                cells.first.push_back(std::uint32_t(cells.lights.size()));
                const auto lights = from->at(x, y);
                cells.lights.insert(cells.lights.end(), lights.begin(), lights.end());
            }
        cells.first.push_back(std::uint32_t(cells.lights.size()));
        return cells;
    }

    // Full-resolution pixels, row by row in parallel.
    Cells pixels(Cells cells) const {
        struct Row {
            std::vector<std::uint32_t> first;
            std::vector<CellLight> lights;
        };
        std::vector<Row> rows(std::size_t(cells.window.height()));
        parallel_for(int(rows.size()), workers_, [&](int i) {
            Row& row = rows[std::size_t(i)];
            for (int x = cells.window.x0; x < cells.window.x1; ++x) {
                row.first.push_back(std::uint32_t(row.lights.size()));
                add_pixel(x, cells.window.y0 + i, row.lights);
            }
        });
        for (const Row& row : rows) {
            const auto before = std::uint32_t(cells.lights.size());
            for (const std::uint32_t first : row.first) cells.first.push_back(before + first);
            cells.lights.insert(cells.lights.end(), row.lights.begin(), row.lights.end());
        }
        cells.first.push_back(std::uint32_t(cells.lights.size()));
        return cells;
    }

    // The light of a pixel for each turn of level 0, once.
    void add_pixel(int x, int y, std::vector<CellLight>& lights) const {
        const std::size_t begin = lights.size();
        engine::for_each_sample(plan_.strip, *plan_.surfaces, plan_.sizes.farthest_px(), x, y,
                                [&](Rgba colour, float coc_px, float covered, bool hidden) {
                                    plan_.sizes.hand_out(coc_px, hidden, [&](int turn, float share) {
                                        if (plan_.sizes.level_of_turn(turn) != 0) return;
                                        auto known = std::find_if(
                                            lights.begin() + std::ptrdiff_t(begin), lights.end(),
                                            [turn](const CellLight& l) { return l.entry == turn; });
                                        if (known == lights.end())
                                            known = lights.insert(known, CellLight()), known->entry = turn;
                                        known->colour += share * colour, known->covered += share * covered;
                                    });
                                });
    }

    Context& context_;
    const GatherPlan& plan_;
    const PackedAtlas& atlas_;
    Workers& workers_;
    std::vector<int> reach_of_entry_;
    std::vector<std::uint64_t> taps_of_entry_, taps_;  // by tile, as far as they are known
    KernelsOnDevice kernels_;
};

}  // namespace

void gather_tiles(Context& context, const GatherPlan& plan, const PackedAtlas& atlas, Target out,
                  const Control& control) {
    Gatherer gatherer(context, plan, atlas, control.workers);
    const std::size_t tiles = plan.tiles.size();
    for (std::size_t begin = 0; begin < tiles && !control.progress.cancelled();) {
        const std::size_t end = gatherer.end_of(begin, context.at_once(kMostTiles));
        try {
            if (plan.tiles[begin].is_sharp)
                gatherer.copy(begin, end, out);
            else
                gatherer.draw(begin, end, out);
        } catch (const Failed& failed) {
            if (end - begin == 1 || !context.halves(failed)) throw;
            continue;
        }
        control.progress.advance(control.share * double(end - begin) / double(tiles));
        begin = end;
    }
}

}  // namespace petzval::device::vulkan
