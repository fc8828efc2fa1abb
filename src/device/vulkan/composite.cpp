#include "device/vulkan/composite.h"

#include "device/vulkan/canvas.h"
#include "device/vulkan/holdout.h"
#include "device/vulkan/words.h"
#include "laws/tiles.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using engine::Arrival;
using engine::LevelRun;
using engine::ScatterPlan;
using engine::Source;
using engine::Tile;
using engine::TileLayer;

constexpr std::size_t kTilePixels = std::size_t(ScatterPlan::kTile) * ScatterPlan::kTile;
constexpr std::size_t kPartialBytes = kTilePixels * (sizeof(Rgba) + sizeof(float));  // of a tile's sector
constexpr std::uint32_t kGroupsPerTile = kTilePixels / laws::kGroup;

static_assert(sizeof(Arrival) == 2 * sizeof(std::uint32_t), "as composite.comp has it");
static_assert(Source::kSkirtBits == 2, "as composite.comp has it");

// Offsets of a batch's parts in the words of the plan (composite.comp's Push).
struct Push {
    std::uint32_t tiles = 0, layers = 0, runs = 0, arrivals = 0, shares = 0;
    std::uint32_t first_layer = 0, first_run = 0, first_arrival = 0;
    std::uint32_t records = 0;
    std::uint32_t held_row = 0, held_width = 0, held_samples = 0;
};
static_assert(sizeof(Push) == 48);

// Tiles begin…end - 1 of a plan.
struct Batch {
    std::size_t begin = 0, end = 0, sectors = 0;
};

struct SourcesOnDevice {
    Piece piece;
    std::vector<std::uint32_t> bases;  // per level: offset to subtract from the number of a source
};

class Compositor {
public:
    Compositor(Context& context, const ScatterPlan& plan, const PackedAtlas& atlas, const BatchRule& rule)
        : context_(context), plan_(plan), atlas_(atlas), rule_(rule) {}

    // Draws all tiles. Returns the number of kernel taps.
    std::uint64_t draw_all(Target out, const Control& control) {
        const std::size_t tiles = plan_.tiles.size() - 1;
        std::uint64_t taps = 0;
        for (std::size_t begin = 0; begin < tiles && !control.progress.cancelled();) {
            const Batch batch = batch_from(begin);
            try {
                taps += draw(batch, out);
            } catch (const Failed& failed) {
                if (batch.end - batch.begin == 1 || !context_.halves(failed)) throw;
                continue;
            }
            control.progress.advance(control.share * double(batch.end - begin) / double(tiles));
            begin = batch.end;
        }
        return taps;
    }

private:
    // Chooses the tiles from `begin` on that one submission draws.
    Batch batch_from(std::size_t begin) const {
        constexpr std::size_t kMostTiles = 4000;  // groups are counted up to 65535
        Batch batch{begin, begin, 0};
        const std::size_t most_bytes = context_.at_once(rule_.most_partial_bytes);
        const std::uint64_t most_work = std::min(rule_.most_multiply_adds, context_.most_work("composite"));
        std::uint64_t taps = 0;
        while (batch.end + 1 < plan_.tiles.size() && batch.end - begin < kMostTiles) {
            const std::size_t sectors = std::size_t(plan_.tiles[batch.end].sectors);
            const std::uint64_t more = taps_of(batch.end);
            const bool is_full =
                (batch.sectors + sectors) * kPartialBytes > most_bytes || 4 * (taps + more) > most_work;
            if (is_full && batch.end > begin) break;
            batch.sectors += sectors, taps += more, ++batch.end;
        }
        return batch;
    }

    // Draws a batch. Returns the number of kernel taps.
    std::uint64_t draw(const Batch& batch, Target out) {
        Recording recording(context_);
        Push push;
        const SourcesOnDevice sources = uploaded_sources(batch, recording);
        const Piece words = uploaded_lists(batch, sources.bases, push, recording);
        const KernelsOnDevice kernels = kernels_for(batch, recording);
        const HoldoutWords held = holdout_for(batch);
        push.held_row = held.row, push.held_width = held.width, push.held_samples = held.samples;
        const Piece holdout = recording.uploaded(std::span<const std::uint32_t>(held.words));
        push.records = kernels.records;
        const std::size_t tiles = batch.end - batch.begin, pixels = batch.sectors * kTilePixels;
        Heap& heap = context_.heap();
        const Piece light = heap.allocate(Kind::OnDevice, pixels * sizeof(Rgba)),
                    taken = heap.allocate(Kind::OnDevice, pixels * sizeof(float)),
                    result = heap.allocate(Kind::OnDevice, tiles * kTilePixels * sizeof(Rgba));
        int most_sectors = 1;
        for (std::size_t t = batch.begin; t < batch.end; ++t)
            most_sectors = std::max(most_sectors, plan_.tiles[t].sectors);
        recording.pass(
            "composite", context_.program(Shader::Composite, plan_.holdout.empty() ? 0 : 1),
            {&words, &sources.piece, &kernels.words, &kernels.weights, &holdout, &light, &taken}, push,
            {std::uint32_t(tiles) * kGroupsPerTile, std::uint32_t(most_sectors)},
            {words.size() + sources.piece.size() + light.size() + taken.size(), 4 * taps_of_batch_});
        recording.pass("add sectors", context_.program(Shader::AddSectors), {&words, &light, &taken, &result},
                       push.tiles, {std::uint32_t(tiles) * kGroupsPerTile},
                       {light.size() + taken.size() + result.size(), 0});
        std::vector<Rect> places;
        for (std::size_t t = batch.begin; t < batch.end; ++t)
            places.push_back(plan_.tiles[t].pixels.moved(0, plan_.first_row));
        Delivery delivery(context_, out);
        delivery.squares(recording, result, places, ScatterPlan::kTile);
        context_.note_work("composite", 4 * taps_of_batch_, recording.run());
        delivery.finish();
        return taps_of_batch_;
    }

    std::uint64_t taps_of(std::size_t tile) const {
        std::uint64_t taps = 0;
        const auto [begin, end] = arrivals_of(tile, tile + 1);
        for (std::size_t i = begin; i < end; ++i) taps += atlas_[plan_.arrivals[i].kernel].taps;
        return taps;
    }
    // Arrivals of tiles begin…end - 1.
    std::pair<std::size_t, std::size_t> arrivals_of(std::size_t begin, std::size_t end) const {
        const auto first = [&](std::size_t tile) {
            return plan_.runs[plan_.layers[plan_.tiles[tile].first_layer].first_run].first_arrival;
        };
        return {first(begin), first(end)};
    }

    // Uploads the batch's part of the plan's lists, each with the element that closes it. bases: as
    // SourcesOnDevice has them.
    Piece uploaded_lists(const Batch& batch, const std::vector<std::uint32_t>& bases, Push& push,
                         Recording& recording) const {
        std::vector<std::uint32_t> words;
        const std::uint32_t first_layer = plan_.tiles[batch.begin].first_layer,
                            last_layer = plan_.tiles[batch.end].first_layer;
        const auto [first_run, last_run] = runs_of(batch);
        const auto [first_arrival, last_arrival] = arrivals_of(batch.begin, batch.end);
        const std::size_t count = last_arrival - first_arrival;
        push.first_layer = first_layer, push.first_run = first_run;
        push.first_arrival = std::uint32_t(first_arrival);
        add_tiles(batch, words);
        push.layers = std::uint32_t(words.size());
        for (std::uint32_t l = first_layer; l <= last_layer; ++l) add_layer(l, l < last_layer, words);
        push.runs = std::uint32_t(words.size());
        for (std::uint32_t r = first_run; r <= last_run; ++r) {
            const LevelRun& run = plan_.runs[r];
            const std::uint32_t base = r < last_run ? bases[std::size_t(run.level)] : 0;
            words.insert(words.end(), {run.first_arrival, std::uint32_t(run.level), base});
        }
        push.arrivals = std::uint32_t(words.size());
        std::vector parts{std::as_bytes(std::span(words)),
                          std::as_bytes(std::span(plan_.arrivals).subspan(first_arrival, count))};
        if (!plan_.shares.empty()) {
            push.shares = push.arrivals + std::uint32_t(2 * count);
            parts.push_back(std::as_bytes(std::span(plan_.shares).subspan(first_arrival, count)));
        }
        return recording.uploaded(parts);
    }
    // The first run of a batch, and the first of the next batch.
    std::pair<std::uint32_t, std::uint32_t> runs_of(const Batch& batch) const {
        const auto first = [&](std::size_t tile) {
            return plan_.layers[plan_.tiles[tile].first_layer].first_run;
        };
        return {first(batch.begin), first(batch.end)};
    }
    void add_tiles(const Batch& batch, std::vector<std::uint32_t>& words) const {
        std::size_t partial = 0;
        for (std::size_t t = batch.begin; t <= batch.end; ++t) {
            const Tile& tile = plan_.tiles[t];
            const Rect& r = tile.pixels;
            words.insert(words.end(),
                         {std::uint32_t(r.x0), std::uint32_t(r.y0), std::uint32_t(r.x1), std::uint32_t(r.y1),
                          tile.first_layer, std::uint32_t(tile.sectors), std::uint32_t(partial), 0});
            partial += std::size_t(tile.sectors) * kTilePixels;
        }
    }
    // With the radii that its light comes from, where a holdout asks.
    void add_layer(std::uint32_t number, bool has_light, std::vector<std::uint32_t>& words) const {
        const TileLayer& layer = plan_.layers[number];
        float low = 1e30f, high = -1e30f;
        if (has_light && !plan_.holdout.empty())
            for (std::uint32_t r = layer.first_run; r < layer.first_empty_run; ++r) {
                const int level = plan_.runs[r].level;
                const auto& sources = plan_.levels[std::size_t(level)].sources;
                for (std::size_t i = plan_.runs[r].first_arrival; i < plan_.runs[r + 1].first_arrival; ++i) {
                    const float coc_px =
                        engine::radius_in_pixels(sources[plan_.arrivals[i].source].radius, level);
                    low = std::min(low, coc_px), high = std::max(high, coc_px);
                }
            }
        words.insert(words.end(), {layer.first_run, layer.first_empty_run, bits_of(low), bits_of(high),
                                   std::uint32_t(layer.layer)});
    }
    // Uploads each level's sources from the first to the last that arrives.
    SourcesOnDevice uploaded_sources(const Batch& batch, Recording& recording) const {
        struct Span {
            std::uint32_t begin = std::numeric_limits<std::uint32_t>::max(), end = 0;
        };
        std::vector<Span> spans(plan_.levels.size());
        const auto [first_run, last_run] = runs_of(batch);
        for (std::uint32_t r = first_run; r < last_run; ++r) {
            // Sources ascend within a run.
            const std::uint32_t first = plan_.arrivals[plan_.runs[r].first_arrival].source,
                                last = plan_.arrivals[plan_.runs[r + 1].first_arrival - 1].source;
            Span& span = spans[std::size_t(plan_.runs[r].level)];
            span = {std::min(span.begin, first), std::max(span.end, last + 1)};
        }
        SourcesOnDevice made;
        std::vector<std::span<const std::byte>> parts;
        std::uint32_t before = 0;
        for (std::size_t l = 0; l < spans.size(); ++l) {
            const auto [begin, end] = spans[l];
            made.bases.push_back(begin - before);
            if (begin >= end) continue;
            parts.push_back(std::as_bytes(std::span(plan_.levels[l].sources).subspan(begin, end - begin)));
            before += end - begin;
        }
        made.piece = recording.uploaded(parts);
        return made;
    }

    KernelsOnDevice kernels_for(const Batch& batch, Recording& recording) {
        std::vector<bool> asked(atlas_.size());
        taps_of_batch_ = 0;
        const auto [begin, end] = arrivals_of(batch.begin, batch.end);
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t kernel = plan_.arrivals[i].kernel;
            asked[kernel] = true, taps_of_batch_ += atlas_[kernel].taps;
        }
        std::vector<std::uint32_t> kernels;
        for (std::uint32_t k = 0; k < asked.size(); ++k)
            if (asked[k]) kernels.push_back(k);
        return atlas_.uploaded(kernels, recording);
    }

    // Holdout of the batch's rows.
    HoldoutWords holdout_for(const Batch& batch) const {
        int begin = std::numeric_limits<int>::max(), end = 0;
        for (std::size_t t = batch.begin; t < batch.end; ++t) {
            begin = std::min(begin, plan_.tiles[t].pixels.y0);
            end = std::max(end, plan_.tiles[t].pixels.y1);
        }
        return {plan_.holdout, begin, end, plan_.rows.x1};
    }

    Context& context_;
    const ScatterPlan& plan_;
    const PackedAtlas& atlas_;
    const BatchRule rule_;
    std::uint64_t taps_of_batch_ = 0;
};

}  // namespace

Work composite_tiles(Context& context, const ScatterPlan& plan, const PackedAtlas& atlas, Target out,
                     const Control& control, const BatchRule& rule) {
    Compositor compositor(context, plan, atlas, rule);
    Work work = Work::of_taps(compositor.draw_all(out, control));
    work.bytes += plan.arrivals.size() * (sizeof(Arrival) + sizeof(Source));
    return work;
}

}  // namespace petzval::device::vulkan
