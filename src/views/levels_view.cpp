#include "base/parallel.h"
#include "device/cpu/atlas.h"
#include "views/plan_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace petzval::views {

using namespace engine;

namespace {

constexpr int kBand = 64;  // rows of cells done at once

// Linear; level 0 is grey, the others after Okabe and Ito ("Color universal design", 2008), whom colour blind
// readers can follow.
constexpr std::array<Rgba, 8> kColours{{{0.5f, 0.5f, 0.5f, 1},
                                        {0.093f, 0.456f, 0.815f, 1},
                                        {0, 0.342f, 0.171f, 1},
                                        {0.871f, 0.776f, 0.054f, 1},
                                        {0.791f, 0.347f, 0, 1},
                                        {0.665f, 0.112f, 0, 1},
                                        {0.604f, 0.191f, 0.386f, 1},
                                        {0, 0.168f, 0.445f, 1}}};
constexpr Rgba kHighlightColour{1, 1, 1, 1};

Rgba colour_of(int level) { return kColours[std::size_t(level) % kColours.size()]; }

std::string name_of_level(int level, const LevelRule& rule) {
    const auto largest = int(std::lround(rule.radius_at(float(level))));
    if (level == 0) return "LEVEL 0  PIXELS, RADII TO " + std::to_string(largest) + " PX";
    return "LEVEL " + std::to_string(level) + "  CELLS " + std::to_string(1 << level) + " PX, RADII TO " +
           std::to_string(largest) + " PX";
}

// The places of all levels in the oversized picture.
struct Layout {
    std::vector<Rect> levels;
    Rect highlights, map, all;

    Layout(int width, int height, int count) {
        int x = 0, lowest = height + (height + 1) / 2;
        levels.push_back({0, 0, width, height});
        for (int l = 1; l < count; ++l) {
            const int w = (width + (1 << l) - 1) >> l, h = (height + (1 << l) - 1) >> l;
            levels.push_back({x, height, x + w, height + h});
            x += w;
        }
        highlights = {width, 0, 2 * width, height};
        const int left = std::max(width, x);
        map = {left, height, left + (width + 1) / 2, lowest};
        all = {0, 0, std::max(2 * width, map.x1), lowest};
    }
};

// Visits the kernels that a source is spread with: visit(zone's ask, share).
template <typename Visit>
void for_kernels(const ScatterKernels& kernels, const Rect& frame, const Source& s, int level,
                 const Visit& visit) {
    for (const auto& [zone, share] : kernels.zones_for(frame, level, s.x, s.y(), s.radius))
        if (share > 0) visit(kernels.ask(level, zone, s.radius, s.skirt_of(), false), share);
}

device::KernelSet kernels_of(const ScatterKernels& kernels, const Rect& frame, const SourceArray& sources,
                             int level) {
    std::set<device::KernelAsk> asks;
    for (const Source& s : sources.sources)
        if (!is_emptiness(s.layer))
            for_kernels(kernels, frame, s, level,
                        [&](const device::KernelAsk& ask, float) { asks.insert(ask); });
    return {{asks.begin(), asks.end()}};
}

// All that the sources of one level send, over all depths.
void accumulate(const PlannedStrip& strip, int level, View<Rgba> out) {
    const EngineView& input = strip.input;
    const SourceArray& sources = strip.scatter.levels[std::size_t(level)];
    const device::KernelSet set = kernels_of(strip.kernels, input.lens.frame, sources, level);
    const device::StampAtlas atlas(
        device::laid_out<device::StampSet>(strip.kernels, set, "stamping", *input.services.memory,
                                           {*input.services.workers, *input.services.progress}));
    parallel_for((out.height() + kBand - 1) / kBand, *input.services.workers, [&](int band) {
        if (input.services.progress->cancelled()) return;
        const Rect rows{0, band * kBand, out.width(), std::min(out.height(), (band + 1) * kBand)};
        std::array<Accumulator, 1> cells;
        cells[0].reset(rows);
        const int reach = strip.kernels.reach(level);
        for (int y = rows.y0 - reach; y < rows.y1 + reach; ++y)
            for (const Source& s : sources.row(y)) {
                if (is_emptiness(s.layer)) continue;
                for_kernels(strip.kernels, input.lens.frame, s, level,
                            [&](const device::KernelAsk& ask, float share) {
                                const auto place = std::lower_bound(set.asks.begin(), set.asks.end(), ask);
                                stamp(atlas[std::uint32_t(place - set.asks.begin())].kernels, s.x, s.y(),
                                      s.light * share, s.tilt_x, s.tilt_y, cells);
                            });
            }
        for (int y = rows.y0; y < rows.y1; ++y) std::copy_n(cells[0].row(y), out.width(), out.row(y));
    });
}

// Every pixel of half the size: the colours of the levels, by the lens area that each drew there, on the
// picture's own brightness.
void draw_map(const EngineView& input, View<const Rgba> atlas, const Layout& layout, View<Rgba> out) {
    const auto shown = [](float light) { return 0.25f + 0.75f * light / (light + 0.5f); };
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            const int u = std::min(2 * x, input.width() - 1), v = std::min(2 * y, input.height() - 1);
            Rgba sum;
            float area = 0;
            for (std::size_t l = 0; l < layout.levels.size(); ++l) {
                const Rect& at = layout.levels[l];
                const float covered = atlas(at.x0 + (u >> l), at.y0 + (v >> l)).a;
                sum += covered * colour_of(int(l)), area += covered;
            }
            const Rgba light = atlas(layout.highlights.x0 + u, layout.highlights.y0 + v);
            const float bright = luminance(light), brightness = luminance(input.samples.colour(u, v));
            const Rgba drawn = area > 0 ? sum * (shown(std::max(0.0f, brightness)) / area) : Rgba{};
            const float white = bright > 0 ? bright / (bright + 0.5f) : 0;
            out(x, y) = drawn * (1 - white) + white * kHighlightColour;
            out(x, y).a = 1;
        }
}

}  // namespace

void LevelsView::read(const PlannedStrip& strip) {
    const EngineView& input = strip.input;
    const std::size_t levels = strip.scatter.levels.size();
    const Layout layout(input.width(), input.height(), int(levels));
    shown_.image = Picture(layout.all.width(), layout.all.height(), Rgba{0, 0, 0, 1});
    for (std::size_t l = 0; l < levels; ++l) {
        accumulate(strip, int(l), shown_.image.view().part(layout.levels[l]));
        shown_.panels.push_back(
            {name_of_level(int(l), strip.scatter.rule), layout.levels[l], colour_of(int(l))});
        if (!input.services.progress->advance(0.8 / double(levels))) return;
    }
    const View<Rgba> bright = shown_.image.view().part(layout.highlights);
    draw_lights(strip, bright);
    shown_.panels.push_back({"HIGHLIGHTS  EACH WITH ITS WHOLE KERNEL", layout.highlights, kHighlightColour});
    draw_map(input, shown_.image, layout, shown_.image.view().part(layout.map));
    shown_.panels.push_back({"WHICH LEVEL DREW WHAT", layout.map, {}});
}

}  // namespace petzval::views
