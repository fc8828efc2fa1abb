#include "engine/samples/lamps/lamps.h"

#include "base/parallel.h"
#include "engine/samples/lamps/lamp_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

// Extent of the lamp along a direction; a pixel that is lit less reaches less far.
std::pair<float, float> extent(const Lamp& lamp, const LampLight& light, float dx, float dy) {
    float low = 1e30f, high = -1e30f;
    for (const LampPixel p : lamp.pixels) {
        const float at = dx * float(p.x) + dy * float(p.y);
        const float reach = std::min(1.0f, luminance(light.at(p.x, p.y)) / lamp.peak) - 0.5f;
        low = std::min(low, at - reach), high = std::max(high, at + reach);
    }
    return {low, high};
}

// Calls visit(x, y, light) for each hidden pixel of a lamp.
template <typename Visit>
void complete(const Lamp& lamp, const LampLight& light, const Visit& visit) {
    if (lamp.pixels.empty() || lamp.cuts <= 0 || lamp.lit <= 0) return;
    // Direction across the edge, from the visible part to the occluder.
    float nx = float(lamp.cut_x / lamp.cuts - lamp.lit_x / lamp.lit),
          ny = float(lamp.cut_y / lamp.cuts - lamp.lit_y / lamp.lit);
    const float length = std::hypot(nx, ny);
    if (length < 0.1f) return;
    nx /= length;
    ny /= length;
    const auto [begin, end] = extent(lamp, light, nx, ny);
    const auto [left, right] = extent(lamp, light, -ny, nx);
    const float shows = end - begin, hidden = std::min(right - left - shows, shows);
    if (hidden <= 0) return;
    const float across = begin + 0.5f * (shows + hidden), along = 0.5f * (left + right);
    const float centre_x = across * nx - along * ny, centre_y = across * ny + along * nx;
    const int reach = int(std::ceil(hidden)) + 1;
    const Rect around = lamp.bounds.grown(reach);
    for (int y = around.y0; y < around.y1; ++y)
        for (int x = around.x0; x < around.x1; ++x)
            if (const float hides = light.hides(x, y, lamp.coc_px); hides > 0) {
                const Rgba mirrored = hides * light.at(2 * centre_x - float(x), 2 * centre_y - float(y));
                if (mirrored != Rgba{}) visit(x, y, mirrored);
            }
}

}  // namespace

HiddenLamps lamps_behind(const LitPicture& picture, View<const float> coc, const Mixtures& mixtures,
                         Workers& workers) {
    std::vector<std::vector<LampPixel>> seeds(static_cast<std::size_t>(coc.height()));
    parallel_for(coc.height(), workers, [&](int y) {
        for (int x = 0; x < coc.width(); ++x)
            if (const Mixture* m = mixtures.at(x, y); m && m->far_light != Rgba{})
                seeds[std::size_t(y)].push_back({x, y});
    });
    HiddenLamps lamps;
    if (std::all_of(seeds.begin(), seeds.end(), [](const auto& row) { return row.empty(); })) return lamps;
    lamps.rows.resize(seeds.size());
    const LampLight light(picture, coc, mixtures);
    LampFinder finder(light, coc.rect());
    for (const auto& row : seeds)
        for (const LampPixel p : row) {
            const Lamp lamp = finder.lamp_at(p.x, p.y);
            complete(lamp, light, [&](int x, int y, Rgba lit) {
                lamps.rows[std::size_t(y)].push_back({x, lamp.coc_px, {lit.r, lit.g, lit.b, 0}});
            });
        }
    // Two lamps that meet behind an edge may be two parts of one: the brighter one counts.
    parallel_for(coc.height(), workers, [&](int y) {
        std::vector<HiddenLamp>& row = lamps.rows[std::size_t(y)];
        std::sort(row.begin(), row.end(), [](const HiddenLamp& a, const HiddenLamp& b) {
            return a.x != b.x ? a.x < b.x : luminance(a.light) > luminance(b.light);
        });
        row.erase(std::unique(row.begin(), row.end(),
                              [](const HiddenLamp& a, const HiddenLamp& b) { return a.x == b.x; }),
                  row.end());
    });
    return lamps;
}

}  // namespace petzval::engine
