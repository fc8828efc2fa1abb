#include "device/vulkan/gather.h"

#include "base/parallel.h"
#include "device/vulkan/canvas.h"
#include "device/vulkan/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using engine::CellLevel;
using engine::CellLight;
using engine::GatherPlan;

constexpr int kTile = GatherPlan::kTile;
constexpr std::size_t kTilePixels = std::size_t(kTile) * kTile;
constexpr std::uint32_t kGroupsPerTile = 64;
constexpr std::size_t kMostTiles = 16;  // of one submission, so that none is long

static_assert(kTile == 128 && GatherPlan::kTentBorder == 1, "as gather.comp has it");

struct Push {
    std::uint32_t tiles = 0, levels = 0, turns = 0, places = 0;
    std::uint32_t turn_count = 0, ring_count = 0, records = 0, is_opaque = 0, open_edges = 0;
};
static_assert(sizeof(Push) == 36);

// Cells of one level, rows begin…end - 1: their light by turn.
struct Cells {
    int width = 0, height = 0, begin = 0, end = 0;
    std::vector<std::uint32_t> first;
    std::vector<CellLight> lights;
};

class Gatherer {
public:
    Gatherer(Context& context, const GatherPlan& plan, const PackedAtlas& atlas, Workers& workers)
        : context_(context), plan_(plan), atlas_(atlas), workers_(workers) {
        for (const auto& turn : plan.sizes.turns()) {
            std::uint64_t taps = 0;
            for (int zone = 0; zone < plan.zones.count() && taps == 0; ++zone)
                if (const std::uint32_t kernel = plan.kernel(turn.ring, zone); kernel < atlas.size())
                    taps = atlas[kernel].taps;
            taps_of_turn_.push_back(taps);
        }
    }

    // Tiles begin…end - 1, which lie in one row. False: they are too many at once, and none is drawn.
    bool draw(std::size_t begin, std::size_t end, Target out) const {
        std::vector<Rect> tiles;
        for (std::size_t t = begin; t < end; ++t) tiles.push_back(plan_.tiles[t].pixels);
        Push push;
        std::uint64_t taps = 0;
        const std::vector<std::uint32_t> said = words_of(tiles, push, taps);
        const std::uint64_t multiply_adds = kSums * taps;
        if (multiply_adds > context_.most_work("gather") && end - begin > 1) return false;
        Recording recording(context_);
        const Piece words = recording.uploaded(std::span<const std::uint32_t>(said));
        std::vector<std::uint32_t> all(atlas_.size());
        for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
        const KernelsOnDevice kernels = atlas_.uploaded(all, recording);
        push.records = kernels.records;
        const std::size_t bytes = tiles.size() * kTilePixels * sizeof(Rgba);
        const Piece result = context_.heap().allocate(Kind::OnDevice, bytes);
        recording.pass("gather", context_.program(Shader::Gather),
                       {&words, &kernels.words, &kernels.weights, &result}, push,
                       {std::uint32_t(tiles.size()) * kGroupsPerTile},
                       {said.size() * sizeof(std::uint32_t) + atlas_.weight_bytes() + bytes, multiply_adds});
        context_.note_work("gather", multiply_adds, deliver(recording, result, tiles, out));
        return true;
    }

    // Tiles begin…end - 1 as the picture has them.
    void copy(std::size_t begin, std::size_t end, Target out) const {
        std::vector<Rect> tiles;
        std::vector<Rgba> squares((end - begin) * kTilePixels);
        auto* to = squares.data();
        for (std::size_t t = begin; t < end; ++t, to += kTilePixels) {
            const Rect& tile = tiles.emplace_back(plan_.tiles[t].pixels);
            for (int y = 0; y < tile.height(); ++y)
                std::copy_n(plan_.strip.colour.row(tile.y0 + y) + tile.x0, tile.width(),
                            to + std::ptrdiff_t(y) * kTile);
        }
        Recording recording(context_);
        deliver(recording, recording.uploaded(std::span<const Rgba>(squares)), tiles, out);
    }

private:
    static constexpr std::uint64_t kSums = 6;  // of a tap: colour, covered, beyond

    // Runs what was recorded; returns the seconds that it took.
    double deliver(Recording& recording, const Piece& squares, std::vector<Rect> tiles, Target out) const {
        for (Rect& tile : tiles) tile = tile.moved(0, plan_.first_row);
        Delivery delivery(context_, out);
        delivery.squares(recording, squares, tiles, kTile);
        const double seconds = recording.run();
        delivery.finish();
        return seconds;
    }

    // taps: of the lights in the tiles themselves, each once.
    std::vector<std::uint32_t> words_of(const std::vector<Rect>& tiles, Push& push,
                                        std::uint64_t& taps) const {
        std::vector<std::uint32_t> words;
        const auto here = [&] { return std::uint32_t(words.size()); };
        for (const Rect& r : tiles)
            words.insert(words.end(), {std::uint32_t(r.x0), std::uint32_t(r.y0), std::uint32_t(r.x1),
                                       std::uint32_t(r.y1)});
        push.places = here(), push.ring_count = std::uint32_t(plan_.sizes.count());
        words.insert(words.end(), plan_.places.begin(), plan_.places.end());
        push.levels = here();
        constexpr std::size_t kLevelWords = 8;
        words.resize(words.size() + std::size_t(plan_.sizes.levels()) * kLevelWords);
        std::vector<bool> has_light(plan_.sizes.turns().size());
        for (int level = 0; level < plan_.sizes.levels(); ++level) {
            const Cells cells = cells_for(tiles, level);
            taps +=
                taps_in(cells, {tiles.front().x0, tiles.front().y0, tiles.back().x1, tiles.back().y1}, level);
            const std::uint32_t first = here();
            words.insert(words.end(), cells.first.begin(), cells.first.end());
            const std::uint32_t lights = here();
            for (const CellLight& l : cells.lights) {
                words.insert(words.end(), {bits_of(l.colour.r), bits_of(l.colour.g), bits_of(l.colour.b),
                                           bits_of(l.colour.a), bits_of(l.covered), bits_of(l.beyond),
                                           std::uint32_t(l.turn)});
                has_light[std::size_t(l.turn)] = true;
            }
            const auto middle = [&](int cell) { return std::ldexp(cell + 0.5, level) - 0.5; };
            const std::uint32_t columns = here();
            for (int x = 0; x < cells.width; ++x)
                words.push_back(std::uint32_t(plan_.zones.column_of(middle(x))));
            const std::uint32_t rows = here();
            for (int y = 0; y < cells.height; ++y)
                words.push_back(std::uint32_t(plan_.zones.row_of(middle(y)) * plan_.zones.columns));
            const std::array<std::uint32_t, kLevelWords> header{
                std::uint32_t(cells.width),
                std::uint32_t(cells.height),
                std::uint32_t(cells.begin),
                first,
                lights,
                columns,
                rows,
                std::uint32_t(plan_.reach[std::size_t(level)])};
            std::copy(header.begin(), header.end(),
                      words.begin() + std::ptrdiff_t(push.levels + std::size_t(level) * kLevelWords));
        }
        push.turns = here();
        for (std::uint32_t turn = 0; turn < has_light.size(); ++turn) {
            const auto [ring, hidden] = plan_.sizes.turns()[turn];
            if (hidden && !has_light[turn]) continue;
            words.insert(words.end(), {turn, std::uint32_t(ring), std::uint32_t(plan_.sizes.level(ring))});
            ++push.turn_count;
        }
        const engine::OpenEdges& open = plan_.strip.open_edges;
        push.open_edges =
            (open.left ? 1u : 0u) | (open.top ? 2u : 0u) | (open.right ? 4u : 0u) | (open.bottom ? 8u : 0u);
        push.is_opaque = plan_.opaque ? 1 : 0;
        return words;
    }

    // Of the lights of these pixels' cells; kernels as they are in the first zone that has them.
    std::uint64_t taps_in(const Cells& cells, const Rect& pixels, int level) const {
        std::uint64_t taps = 0;
        const int last_row = std::min((pixels.y1 - 1) >> level, cells.end - 1),
                  last_column = std::min((pixels.x1 - 1) >> level, cells.width - 1);
        for (int y = std::max(pixels.y0 >> level, cells.begin); y <= last_row; ++y) {
            const std::size_t row = std::size_t(y - cells.begin) * std::size_t(cells.width);
            const std::uint32_t first = cells.first[row + std::size_t(pixels.x0 >> level)],
                                last = cells.first[row + std::size_t(last_column) + 1];
            for (std::uint32_t i = first; i < last; ++i)
                taps += taps_of_turn_[std::size_t(cells.lights[i].turn)];
        }
        return taps;
    }

    // All that the tiles may read.
    Cells cells_for(const std::vector<Rect>& tiles, int level) const {
        Cells cells;
        const CellLevel* const from = level > 0 ? &plan_.levels[std::size_t(level - 1)] : nullptr;
        cells.width = from ? from->width() : plan_.strip.width();
        cells.height = from ? from->height() : plan_.strip.height();
        const Rect window = GatherPlan::cells_of(tiles.front(), level).grown(plan_.reach[std::size_t(level)]);
        cells.begin = std::clamp(window.y0, 0, cells.height - 1);
        cells.end = std::clamp(window.y1, cells.begin + 1, cells.height);
        if (!from) return pixels(std::move(cells));
        for (int y = cells.begin; y < cells.end; ++y)
            for (int x = 0; x < cells.width; ++x) {
                cells.first.push_back(std::uint32_t(cells.lights.size()));
                const auto lights = from->at(x, y);
                cells.lights.insert(cells.lights.end(), lights.begin(), lights.end());
            }
        cells.first.push_back(std::uint32_t(cells.lights.size()));
        return cells;
    }

    // At full resolution, row by row in parallel.
    Cells pixels(Cells cells) const {
        struct Row {
            std::vector<std::uint32_t> first;
            std::vector<CellLight> lights;
        };
        std::vector<Row> rows(std::size_t(cells.end - cells.begin));
        parallel_for(int(rows.size()), workers_, [&](int i) {
            Row& row = rows[std::size_t(i)];
            for (int x = 0; x < cells.width; ++x) {
                row.first.push_back(std::uint32_t(row.lights.size()));
                add_pixel(x, cells.begin + i, row.lights);
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
        engine::for_each_sample(
            plan_.strip, plan_.guessed, x, y, [&](Rgba colour, float coc_px, float covered, bool hidden) {
                plan_.sizes.hand_out(coc_px, hidden, [&](int turn, float share) {
                    if (plan_.sizes.level_of_turn(turn) != 0) return;
                    auto known = std::find_if(lights.begin() + std::ptrdiff_t(begin), lights.end(),
                                              [turn](const CellLight& l) { return l.turn == turn; });
                    if (known == lights.end()) known = lights.insert(known, CellLight()), known->turn = turn;
                    known->colour += share * colour, known->covered += share * covered;
                });
            });
    }

    Context& context_;
    const GatherPlan& plan_;
    const PackedAtlas& atlas_;
    Workers& workers_;
    std::vector<std::uint64_t> taps_of_turn_;
};

}  // namespace

void gather_tiles(Context& context, const GatherPlan& plan, const PackedAtlas& atlas, Target out,
                  const Control& control) {
    const Gatherer gatherer(context, plan, atlas, control.workers);
    const std::size_t tiles = plan.tiles.size();
    std::size_t at_once = kMostTiles;
    for (std::size_t begin = 0; begin < tiles && !control.progress.cancelled();) {
        std::size_t end = begin;
        at_once = std::min(at_once, context.at_once(kMostTiles));
        const auto joins = [&] {
            return end < tiles && plan.tiles[end].is_sharp == plan.tiles[begin].is_sharp &&
                   plan.tiles[end].pixels.y0 == plan.tiles[begin].pixels.y0 && end - begin < at_once;
        };
        while (joins()) ++end;
        bool is_drawn = plan.tiles[begin].is_sharp;
        try {
            if (is_drawn)
                gatherer.copy(begin, end, out);
            else
                is_drawn = gatherer.draw(begin, end, out);
        } catch (const Failed& failed) {
            if (end - begin == 1 || !context.halves(failed)) throw;
            is_drawn = false;
        }
        if (!is_drawn) {
            at_once = (end - begin) / 2;
            continue;
        }
        at_once = std::min(kMostTiles, 2 * at_once);
        control.progress.advance(control.share * double(end - begin) / double(tiles));
        begin = end;
    }
}

}  // namespace petzval::device::vulkan
