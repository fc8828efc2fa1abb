#include "engine/spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace petzval::engine {
namespace {

constexpr float kSteps = 16;  // kernels per unit of radius
constexpr int kBorder = 2;    // cells around a tile that interpolation reads

// Weights of the four cells around a position t (0…1) between the middle two: Catmull-Rom.
std::array<float, 4> cubic(float t) {
    const float t2 = t * t, t3 = t2 * t;
    return {0.5f * (-t3 + 2 * t2 - t), 0.5f * (3 * t3 - 5 * t2 + 2), 0.5f * (-3 * t3 + 4 * t2 + t),
            0.5f * (t3 - t2)};
}

void stamp(const Source& source, float radius, const kernel::PointSpread& spread, int cy, const Rect& area,
           float scale, Picture& out) {
    const Rect e = spread.extent;
    const Rect place = Rect{source.x + e.x0, cy + e.y0, source.x + e.x1, cy + e.y1}.intersected(area);
    // A facet of a slanted surface is seen larger from one side of the pupil than from the other: 1 + slope .
    // u.
    const float tilt_x = std::abs(radius) > 0.5f ? source.slope_x * scale / (radius * scale) : 0;
    const float tilt_y = std::abs(radius) > 0.5f ? source.slope_y * scale / (radius * scale) : 0;
    for (int y = place.y0; y < place.y1; ++y)
        for (int x = place.x0; x < place.x1; ++x) {
            const float tilt = std::max(0.0f, 1 + tilt_x * float(x - source.x) + tilt_y * float(y - cy));
            out(x - area.x0, y - area.y0) +=
                tilt * (spread.weights(x - source.x - e.x0, y - cy - e.y0) * source.light);
        }
}

void add_enlarged(const Picture& coarse, const Rect& area, int level, const Rect& tile, Picture& out) {
    const float size = float(1 << level);
    Picture wide(tile.width(), coarse.height());
    for (int x = 0; x < tile.width(); ++x) {
        const float at = (float(tile.x0 + x) + 0.5f) / size - 0.5f;
        const int c = int(std::floor(at));
        const auto w = cubic(at - float(c));
        for (int y = 0; y < coarse.height(); ++y)
            for (int k = 0; k < 4; ++k) wide(x, y) += w[std::size_t(k)] * coarse(c - 1 + k - area.x0, y);
    }
    for (int y = 0; y < tile.height(); ++y) {
        const float at = (float(tile.y0 + y) + 0.5f) / size - 0.5f;
        const int c = int(std::floor(at));
        const auto w = cubic(at - float(c));
        for (int x = 0; x < tile.width(); ++x) {
            Rgba sum;
            for (int k = 0; k < 4; ++k) sum += w[std::size_t(k)] * wide(x, c - 1 + k - area.y0);
            out(x, y) += Rgba{std::max(0.0f, sum.r), std::max(0.0f, sum.g), std::max(0.0f, sum.b),
                              std::max(0.0f, sum.a)};
        }
    }
}

}  // namespace

SpreadTable::SpreadTable(const kernel::LensModel& lens, float largest_radius) {
    for (int i = 0; i <= int(largest_radius * kSteps) + 1; ++i) {
        far_.push_back(lens.point_spread(float(i) / kSteps, {}));
        near_.push_back(lens.point_spread(-float(i) / kSteps, {}));
    }
}

const kernel::PointSpread& SpreadTable::at(float radius) const {
    const auto& side = radius < 0 ? near_ : far_;
    return side[std::min(side.size() - 1, std::size_t(std::abs(radius) * kSteps + 0.5f))];
}

namespace {
Picture& layer_in(std::map<int, Picture>& layers, int layer, int width, int height) {
    const auto found = layers.find(layer);
    if (found != layers.end()) return found->second;
    return layers.emplace(layer, Picture(width, height)).first->second;
}
}  // namespace

std::vector<Picture> spread_layers(const SourceGrid& grid, const SpreadTable& table, const Rect& tile) {
    std::map<int, Picture> layers;
    for (int l = 0; l < int(grid.levels().size()); ++l) {
        const SourceGrid::Level& level = grid.levels()[std::size_t(l)];
        const int size = 1 << l;
        const Rect area = l == 0
                              ? tile
                              : Rect{tile.x0 / size - kBorder, tile.y0 / size - kBorder,
                                     (tile.x1 - 1) / size + 1 + kBorder, (tile.y1 - 1) / size + 1 + kBorder};
        std::map<int, Picture> coarse;
        constexpr int kReach = 16;
        for (int y = area.y0 - kReach; y < area.y1 + kReach; ++y)
            for (const Source& s : level.row(y)) {
                if (s.x < area.x0 - kReach || s.x >= area.x1 + kReach) continue;
                const float radius = s.coc_px / float(size);
                const kernel::PointSpread& spread = table.at(radius);
                const Rect e = spread.extent;
                if (Rect{s.x + e.x0, y + e.y0, s.x + e.x1, y + e.y1}.intersected(area).empty()) continue;
                Picture& target = layer_in(coarse, s.layer, area.width(), area.height());
                stamp(s, radius, spread, y, area, float(size), target);
            }
        for (auto& [layer, picture] : coarse) {
            if (l == 0) {
                Picture& target = layer_in(layers, layer, tile.width(), tile.height());
                for (std::size_t i = 0; i < picture.size(); ++i) target.pixels()[i] += picture.pixels()[i];
            } else {
                add_enlarged(picture, area, l, tile, layer_in(layers, layer, tile.width(), tile.height()));
            }
        }
    }
    std::vector<Picture> ordered;
    for (auto& [layer, picture] : layers) ordered.push_back(std::move(picture));
    return ordered;
}

}  // namespace petzval::engine
