#include "kernel/draw/halo.h"

#include "base/cancel.h"
#include "kernel/model/pieces.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace petzval::kernel {
namespace {

constexpr double kLeastCells = 32;  // from the source to the end of the halo
// An edge or a line in the halo is seen if it stands out by this fraction of the light of an even disc.
constexpr float kSeen = 0.25f;
constexpr int kMargin = 2;  // cells around what has structure

// Weights of a row of cells, interpolated between the rows above and below the middle of a row of pixels.
std::vector<Rgba> row_between(const PointSpread& cells, double place) {
    const Rect& e = cells.extent;
    const double above = std::floor(place);
    const float share = float(place - above);
    std::vector<Rgba> row(std::size_t(e.width()), Rgba{});
    const auto add = [&](int y, float weight) {
        if (y < e.y0 || y >= e.y1 || weight == 0) return;
        const Rgba* from = cells.weights.row(y - e.y0);
        for (std::size_t x = 0; x < row.size(); ++x) row[x] += from[x] * weight;
    };
    add(int(above), 1 - share);
    add(int(above) + 1, share);
    return row;
}

}  // namespace

int halo_cell_px(double size_px) {
    int cell = 1;
    while (size_px >= 2 * cell * kLeastCells) cell *= 2;
    return cell <= 2 ? 1 : cell;
}

int structure_px(const PointSpread& cells, int cell_px) {
    const Rect& e = cells.extent;
    const auto at = [&](int x, int y) {
        return e.contains(x, y) ? cells.weights(x - e.x0, y - e.y0).a : 0.0f;
    };
    const double radius = 0.5 * std::max(e.width(), e.height());
    const auto least = float(kSeen / (std::numbers::pi * radius * radius));
    double farthest = 0;
    for (int y = e.y0; y < e.y1; ++y)
        for (int x = e.x0; x < e.x1; ++x) {
            const float twice = 2 * at(x, y);
            if (std::abs(at(x - 1, y) + at(x + 1, y) - twice) < least &&
                std::abs(at(x, y - 1) + at(x, y + 1) - twice) < least)
                continue;
            farthest = std::max(farthest, std::hypot(double(x), double(y)));
        }
    return int(std::ceil(farthest) + kMargin) * cell_px;
}

PointSpread with_halo(const PointSpread& fine, const PointSpread& cells, int cell_px, int radius_px,
                      double reach_px) {
    const Rect& e = cells.extent;
    const int reach = int(std::ceil(reach_px));
    const Rect extent =
        Rect{(e.x0 - 1) * cell_px, (e.y0 - 1) * cell_px, e.x1 * cell_px, e.y1 * cell_px}.intersected(
            {-reach, -reach, reach + 1, reach + 1});
    const auto end = float(radius_px), begin = end - float(cell_px);
    const auto share_of_core = [&](float x, float y) {
        const float square = x * x + y * y;
        if (square <= begin * begin) return 1.0f;
        return square >= end * end ? 0.0f : fade(std::sqrt(square), begin, end);
    };
    const float per_pixel = 1 / float(cell_px * cell_px);
    PointSpread whole{extent, Picture(extent.width(), extent.height()), false};
    for (int y = extent.y0; y < extent.y1; ++y) {
        check_cancelled();
        const std::vector<Rgba> row = row_between(cells, double(y) / cell_px);
        for (int x = extent.x0; x < extent.x1; ++x) {
            Rgba& weight = whole.weights(x - extent.x0, y - extent.y0);
            const float core = share_of_core(float(x), float(y));
            if (core > 0 && fine.extent.contains(x, y))
                weight = fine.weights(x - fine.extent.x0, y - fine.extent.y0) * core;
            if (core == 1) continue;
            const double place = double(x) / cell_px, left = std::floor(place);
            const float right = float(place - left);
            const int i = int(left) - e.x0;
            if (i >= 0) weight += row[std::size_t(i)] * ((1 - core) * per_pixel * (1 - right));
            if (i + 1 < e.width()) weight += row[std::size_t(i + 1)] * ((1 - core) * per_pixel * right);
        }
    }
    trim(whole);
    normalise(whole);
    return whole;
}

}  // namespace petzval::kernel
