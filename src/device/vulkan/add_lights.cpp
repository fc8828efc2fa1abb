#include "device/vulkan/add_lights.h"

#include "base/parallel.h"
#include "device/vulkan/canvas.h"
#include "device/vulkan/holdout.h"
#include "device/vulkan/words.h"
#include "laws/tiles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace petzval::device::vulkan {
namespace {

using engine::LightsPlan;
using engine::PlannedLight;
using engine::ShadowGrid;

constexpr int kTile = laws::kLightsTile;
constexpr std::size_t kTilePixels = std::size_t(kTile) * kTile;
constexpr std::uint32_t kGroupsPerTile = kTilePixels / laws::kGroup;

// Lights begin…end - 1 of a plan, with the viewpoints that they have.
struct Batch {
    std::size_t begin = 0, end = 0;
    std::vector<std::uint32_t> views;  // numbers in the plan
    std::vector<std::uint32_t>
        number_of;  // by viewpoint of the plan: place in `views` from 1 on; 0: not here
};

class LightAdder {
public:
    LightAdder(Context& context, const LightsPlan& plan, const PackedAtlas& atlas, const LightsRule& rule)
        : context_(context), plan_(plan), atlas_(atlas), rule_(rule), shadows_(context, plan, rule.shadows) {}

    Batch batch_from(std::size_t begin) const {
        Batch batch{begin, begin, {}, std::vector<std::uint32_t>(plan_.viewpoints.size())};
        std::size_t cells = 0;
        const std::size_t most_cells = context_.at_once(rule_.most_cells),
                          most_views = context_.at_once(rule_.most_views);
        const std::uint64_t most_work = context_.at_once(std::size_t(rule_.most_multiply_adds));
        for (std::uint64_t taps = 0; batch.end < plan_.lights.size(); ++batch.end) {
            const PlannedLight& light = plan_.lights[batch.end];
            taps += atlas_[light.kernel].taps;
            const ShadowGrid grid(plan_.viewpoints[light.viewpoint]);
            const std::size_t side = std::size_t(grid.taps) * std::size_t(grid.parts);
            const bool is_known = batch.number_of[light.viewpoint] > 0;
            const bool is_full =
                4 * taps > most_work ||
                (!is_known && (cells + side * side > most_cells || batch.views.size() >= most_views));
            if (is_full && batch.end > begin) break;
            if (is_known) continue;
            cells += side * side;
            batch.views.push_back(light.viewpoint);
            batch.number_of[light.viewpoint] = std::uint32_t(batch.views.size());
        }
        return batch;
    }

    // Lists what the batch adds where, and finds how much of the pupil each light sees. Shortens the batch if
    // too much is in the way.
    void prepare(Batch& batch, const Control& control) {
        words_.clear(), tiles_.clear(), taps_ = 0;
        for (Piece* piece : {&words_on_device_, &visible_, &holdout_}) *piece = {};
        kernels_ = {};
        const std::size_t fitting = shadows_.search(batch.views, control.workers);
        const auto fits = [&](const PlannedLight& light) {
            return batch.number_of[light.viewpoint] <= fitting;
        };
        const auto first = plan_.lights.begin();
        batch.end = std::size_t(
            std::find_if_not(first + std::ptrdiff_t(batch.begin), first + std::ptrdiff_t(batch.end), fits) -
            first);
        if (control.progress.cancelled()) return;
        list_tiles(batch);
        if (tiles_.empty()) return;
        list_lights(batch);
        push_.views = shadows_.list(words_);
        Recording recording(context_);
        words_on_device_ = recording.uploaded(std::span<const std::uint32_t>(words_));
        visible_ = shadows_.visible(recording, words_on_device_);
        const HoldoutWords held(plan_.holdout, plan_.rows.y0, plan_.rows.y1, plan_.rows.x1);
        push_.held_row = held.row, push_.held_width = held.width, push_.held_samples = held.samples;
        holdout_ = recording.uploaded(std::span<const std::uint32_t>(held.words));
        kernels_ = kernels_for(batch, recording);
        push_.records = kernels_.records;
        recording.run();
        shadows_.finish();
    }

    // Adds what was prepared. Returns the taps drawn.
    std::uint64_t add_all(Target out) {
        for (std::size_t first = 0; first < tiles_.size();) {
            const std::size_t count = std::min(tiles_at_once(), tiles_.size() - first);
            try {
                add(first, count, out);
                first += count;
            } catch (const Failed& failed) {
                if (count == 1 || !context_.halves(failed)) throw;
            }
        }
        return taps_;
    }

private:
    // Multiply-adds of so many tiles, assuming that all are alike.
    std::uint64_t work_of(std::size_t tiles) const { return 4 * taps_ * tiles / tiles_.size(); }
    std::size_t tiles_at_once() const {
        const std::uint64_t most = context_.most_work("add lights");
        return std::clamp<std::size_t>(most / std::max<std::uint64_t>(1, work_of(1)), 1,
                                       context_.at_once(rule_.most_tiles));
    }
    Rect extent_of(const PlannedLight& light) const {
        return atlas_[light.kernel].kernels.front().extent.moved(light.highlight.x, light.highlight.y);
    }

    // Tiles that lights land in, and the lights of each, in order.
    void list_tiles(const Batch& batch) {
        const Rect& rows = plan_.rows;
        const int columns = (rows.width() + kTile - 1) / kTile, lines = (rows.height() + kTile - 1) / kTile;
        std::vector<std::vector<std::uint32_t>> lights(std::size_t(columns) * std::size_t(lines));
        for (std::size_t i = batch.begin; i < batch.end; ++i) {
            const Rect e = extent_of(plan_.lights[i]).intersected(rows);
            if (e.empty()) continue;
            taps_ += std::uint64_t(e.width()) * std::uint64_t(e.height());
            for (int y = (e.y0 - rows.y0) / kTile; y <= (e.y1 - 1 - rows.y0) / kTile; ++y)
                for (int x = (e.x0 - rows.x0) / kTile; x <= (e.x1 - 1 - rows.x0) / kTile; ++x)
                    lights[std::size_t(y) * std::size_t(columns) + std::size_t(x)].push_back(
                        std::uint32_t(i - batch.begin));
        }
        std::vector<std::uint32_t> order;
        push_ = {};
        for (std::size_t t = 0; t < lights.size(); ++t) {
            if (lights[t].empty()) continue;
            const int x = rows.x0 + int(t) % columns * kTile, y = rows.y0 + int(t) / columns * kTile;
            const Rect tile = Rect{x, y, x + kTile, y + kTile}.intersected(rows);
            tiles_.push_back(tile);
            add_rect(words_, tile, order.size());
            order.insert(order.end(), lights[t].begin(), lights[t].end());
        }
        add_rect(words_, {}, order.size());
        push_.order = std::uint32_t(words_.size());
        words_.insert(words_.end(), order.begin(), order.end());
    }

    void list_lights(const Batch& batch) {
        push_.lights = std::uint32_t(words_.size());
        for (std::size_t i = batch.begin; i < batch.end; ++i) {
            const PlannedLight& light = plan_.lights[i];
            const engine::Highlight& h = light.highlight;
            const Rgba colour = h.colour * float(h.size * h.size);
            const std::uint32_t number = batch.number_of[light.viewpoint];
            add_light(words_, light, colour, h.coc_px, shadows_.is_open(number - 1) ? 0 : number,
                      std::uint32_t(plan_.viewpoints[light.viewpoint].first_tap()));
        }
    }

    KernelsOnDevice kernels_for(const Batch& batch, Recording& recording) const {
        std::vector<std::uint32_t> kernels;
        for (std::size_t i = batch.begin; i < batch.end; ++i) kernels.push_back(plan_.lights[i].kernel);
        std::sort(kernels.begin(), kernels.end());
        kernels.erase(std::unique(kernels.begin(), kernels.end()), kernels.end());
        return atlas_.uploaded(kernels, recording);
    }

    void add(std::size_t first, std::size_t count, Target out) {
        constexpr std::uint32_t kTileWords = 5;
        Recording recording(context_);
        const std::size_t bytes = count * kTilePixels * sizeof(Rgba);
        const Piece result = context_.heap().allocate(Kind::OnDevice, bytes);
        LightsPush push = push_;
        push.tiles = std::uint32_t(first) * kTileWords;
        recording.pass("add lights", context_.program(Shader::AddLights, plan_.holdout.empty() ? 0 : 1),
                       {&words_on_device_, &kernels_.words, &kernels_.weights, &visible_, &holdout_, &result},
                       push, {std::uint32_t(count) * kGroupsPerTile},
                       {bytes + words_.size() * sizeof(std::uint32_t), work_of(count)});
        std::vector<Rect> places;
        for (std::size_t t = first; t < first + count; ++t)
            places.push_back(tiles_[t].moved(0, plan_.first_row));
        Delivery delivery(context_, out);
        delivery.squares(recording, result, places, kTile, true);
        context_.note_work("add lights", work_of(count), recording.run());
        delivery.finish();
    }

    Context& context_;
    const LightsPlan& plan_;
    const PackedAtlas& atlas_;
    const LightsRule rule_;
    PupilShadows shadows_;
    // Words of the batch.
    std::vector<std::uint32_t> words_;
    std::vector<Rect> tiles_;
    LightsPush push_;
    Piece words_on_device_, visible_, holdout_;
    KernelsOnDevice kernels_;
    std::uint64_t taps_ = 0;
};

}  // namespace

Work add_planned_lights(Context& context, const LightsPlan& plan, const PackedAtlas& atlas, Target out,
                        const Control& control, const LightsRule& rule) {
    if (plan.lights.empty()) return {};  // and perhaps there are no casters
    LightAdder adder(context, plan, atlas, rule);
    std::uint64_t taps = 0;
    for (std::size_t begin = 0; begin < plan.lights.size() && !control.progress.cancelled();) {
        Batch batch = adder.batch_from(begin);
        try {
            adder.prepare(batch, control);
        } catch (const Failed& failed) {
            if (batch.end - begin == 1 || !context.halves(failed)) throw;
            continue;
        }
        taps += adder.add_all(out);
        begin = batch.end;
    }
    return Work::of_taps(taps);
}

}  // namespace petzval::device::vulkan
