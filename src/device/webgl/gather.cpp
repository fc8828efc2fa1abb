#include "device/webgl/gather.h"

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace petzval::device::webgl {
namespace {

using engine::CellLight;
using engine::GatherPlan;

// Lights by entry (RingSizes): what the page draws into cells before it gathers them.
// A light: x and y in halves of a word, zone, r, g, b, a, covered, beyond.
class Lights {
public:
    explicit Lights(const GatherPlan& plan) : plan_(plan), of_entry_(std::size_t(plan.sizes.entries())) {
        add_pixels();
        for (int level = 1; level < plan.sizes.levels(); ++level) add_cells(level);
    }
    const std::vector<std::pair<std::uint32_t, CellLight>>& of(int entry) const {
        return of_entry_[std::size_t(entry)];
    }
    std::uint32_t zone(std::uint32_t place, int level) const {
        const auto middle = [&](std::uint32_t cell) { return std::ldexp(double(cell) + 0.5, level) - 0.5; };
        return std::uint32_t(plan_.zones.column_of(middle(place & 0xffffu)) +
                             plan_.zones.row_of(middle(place >> 16)) * plan_.zones.columns);
    }

private:
    static std::uint32_t place_of(int x, int y) { return std::uint32_t(x) | std::uint32_t(y) << 16; }

    // The light of a pixel for each turn of level 0, once.
    void add_pixels() {
        for (int y = 0; y < plan_.strip.height(); ++y)
            for (int x = 0; x < plan_.strip.width(); ++x) add_pixel(x, y);
    }
    void add_pixel(int x, int y) {
        const std::uint32_t place = place_of(x, y);
        engine::for_each_sample(plan_.strip, *plan_.surfaces, plan_.sizes.farthest_px(), x, y,
                                [&](Rgba colour, float coc_px, float covered, bool hidden) {
                                    plan_.sizes.hand_out(coc_px, hidden, [&](int turn, float share) {
                                        if (plan_.sizes.level_of_turn(turn) != 0) return;
                                        auto& lights = of_entry_[std::size_t(turn)];
                                        if (lights.empty() || lights.back().first != place)
                                            lights.push_back({place, CellLight{}});
                                        CellLight& light = lights.back().second;
                                        light.colour += share * colour;
                                        light.covered += share * covered;
                                    });
                                });
    }
    void add_cells(int level) {
        const engine::CellLevel& cells = plan_.levels[std::size_t(level - 1)];
        for (int y = 0; y < cells.height(); ++y)
            for (int x = 0; x < cells.width(); ++x)
                for (const CellLight& light : cells.at(x, y))
                    of_entry_[std::size_t(light.entry)].push_back({place_of(x, y), light});
    }

    const GatherPlan& plan_;
    std::vector<std::vector<std::pair<std::uint32_t, CellLight>>> of_entry_;
};

// Appends the lights of an entry; returns where they begin.
int add_lights(const Lights& lights, int entry, int level, Words& words) {
    constexpr std::uint32_t kLightWords = 8;
    const int begin = int(words.count() / kLightWords);
    for (const auto& [place, light] : lights.of(entry)) {
        const Rgba& c = light.colour;
        words.add_all(place, lights.zone(place, level), c.r, c.g, c.b, c.a, light.covered, light.beyond);
    }
    return begin;
}

// A turn: level, first light, lights; the same of its skirt; 1 for a seam; then by zone the kernel of both.
void hand_over_turns(const GatherPlan& plan) {
    const Lights lights(plan);
    Words turns, words;
    for (int turn = 0; turn < int(plan.sizes.turns().size()); ++turn) {
        const int skirt = plan.sizes.skirt_entry(turn), ring = plan.sizes.ring_of_entry(turn);
        const int count = int(lights.of(turn).size()), in_skirt = int(lights.of(skirt).size());
        if (count + in_skirt == 0) continue;
        const int level = plan.sizes.level(ring), coarse = plan.sizes.skirt_level(ring);
        turns.add_all(level, add_lights(lights, turn, level, words), count);
        turns.add_all(coarse, add_lights(lights, skirt, coarse, words), in_skirt);
        turns.add_all(plan.sizes.turns()[std::size_t(turn)].is_seam ? 1 : 0);
        for (int zone = 0; zone < plan.zones.count(); ++zone)
            turns.add_all(plan.kernel(ring, zone, false), plan.kernel(ring, zone, true));
    }
    turns.hand_over("gather turns");
    words.hand_over("gather lights");
}

// Pixels that stay as they were: x and y in halves of a word, r, g, b, a.
void hand_over_sharp(const GatherPlan& plan) {
    Words words;
    for (const GatherPlan::Tile& tile : plan.tiles) {
        if (!tile.is_sharp) continue;
        for (int y = tile.pixels.y0; y < tile.pixels.y1; ++y)
            for (int x = tile.pixels.x0; x < tile.pixels.x1; ++x) {
                const Rgba c = plan.strip.samples.colour(x, y);
                words.add_all(std::uint32_t(x) | std::uint32_t(y) << 16, c.r, c.g, c.b, c.a);
            }
    }
    words.hand_over("gather sharp");
}

}  // namespace

void hand_over_gather(const GatherPlan& plan, const PageAtlas& atlas) {
    const engine::OpenEdges& open = plan.strip.window.open_edges;
    Words head;
    head.add_all(plan.strip.width(), plan.strip.height(), plan.sizes.levels(), plan.zones.count(),
                 plan.opaque ? 1 : 0, open.left ? 1 : 0, open.top ? 1 : 0, open.right ? 1 : 0,
                 open.bottom ? 1 : 0);
    head.hand_over("gather head");
    hand_over_turns(plan);
    hand_over_sharp(plan);
    atlas.hand_over("gather kernels", "gather weights");
}

}  // namespace petzval::device::webgl
