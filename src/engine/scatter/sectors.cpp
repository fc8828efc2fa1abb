#include "engine/scatter/sectors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace petzval::engine {

namespace {

// Grains of a pixel. If there are many sectors, each has only a few grains: their cuts must not jump from
// radius to radius, or a slope leaves part of a sector empty and shows the surface behind it.
int points_per_side(int width, int sectors) {
    const int finer = sectors > 6 ? 2 : 1;
    return finer * (width < 8 ? 4 : width < 14 ? 2 : 1);
}

}  // namespace

std::vector<kernel::PointSpread> sectors_of(const kernel::PointSpread& all, int inner, int outer,
                                            bool turned) {
    struct Grain {
        Rgba light;
        int x, y;
        double distance, turns;
    };
    const Rect e = all.extent;
    const int points = points_per_side(e.width(), inner + outer);
    std::vector<Grain> grains;
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x) {
            const Rgba light = all.weights(x - e.x0, y - e.y0) * (1 / float(points * points));
            if (light.a <= 0) continue;
            for (int i = 0; i < points * points; ++i) {
                const int column = i % points, row = i / points;
                const double u = x + (column + 0.5) / points - 0.5, v = y + (row + 0.5) / points - 0.5;
                const double turns = std::atan2(v, u) / (2 * M_PI) + (turned ? 1 : 0.5);
                grains.push_back({light, x, y, std::hypot(u, v), turns - std::floor(turns)});
            }
        }
    const auto by = [&](std::size_t begin, std::size_t end, double Grain::*key) {
        std::stable_sort(grains.begin() + std::ptrdiff_t(begin), grains.begin() + std::ptrdiff_t(end),
                         [key](const Grain& a, const Grain& b) { return a.*key < b.*key; });
    };
    // Cuts the grains from `begin` on where their light comes to `light`; returns the first beyond.
    const auto cut_at = [&](std::size_t begin, float light) {
        float sum = 0;
        std::size_t i = begin;
        while (i < grains.size() && sum + grains[i].light.a <= light) sum += grains[i++].light.a;
        if (i == grains.size() || light - sum < 1e-7f) return i;
        const float share = (light - sum) / grains[i].light.a;
        Grain rest = grains[i];
        rest.light *= 1 - share, grains[i].light *= share;
        grains.insert(grains.begin() + std::ptrdiff_t(i) + 1, rest);
        return i + 1;
    };
    float whole = 0;
    for (const Grain& g : grains) whole += g.light.a;
    by(0, grains.size(), &Grain::distance);
    std::vector<kernel::PointSpread> sectors;
    std::size_t begin = 0;
    const float count = float(inner + outer);
    for (const int in_ring : {inner, outer}) {
        const bool last_ring = in_ring == outer;
        std::size_t ring_end = last_ring ? grains.size() : cut_at(begin, whole * float(in_ring) / count);
        by(begin, ring_end, &Grain::turns);
        for (int i = 0; i < in_ring; ++i) {
            const std::size_t before = grains.size();
            const std::size_t end = i + 1 == in_ring ? ring_end : cut_at(begin, whole / count);
            ring_end += grains.size() - before;
            kernel::PointSpread sector{e, Picture(e.width(), e.height()), all.neutral};
            for (; begin < end; ++begin)
                sector.weights(grains[begin].x - e.x0, grains[begin].y - e.y0) += count * grains[begin].light;
            sectors.push_back(std::move(sector));
        }
    }
    return sectors;
}

}  // namespace petzval::engine
