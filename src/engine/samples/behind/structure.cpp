#include "engine/samples/behind/structure.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kAround = 2;  // cells on either side that a direction is the mean of

float dot_light(Rgba a, Rgba b) { return a.r * b.r + a.g * b.g + a.b * b.b; }

// Cells no more than kAround from one that holds a silhouette's pixel, and the cells that these are means of.
Image<unsigned char> cells_beside(const Mixtures& mixtures, int width, int height, int cell_px) {
    constexpr int kWithin = 2 * kAround;
    Image<unsigned char> beside(width, height);
    for (int y = 0; y < mixtures.height(); ++y)
        mixtures.for_each_in_row(y, [&](int x, const Mixture&) {
            unsigned char* const row = beside.row(y / cell_px);
            const int from = std::max(0, x / cell_px - kWithin);
            std::fill(row + from, row + std::min(width, x / cell_px + kWithin + 1), 1);
        });
    Image<unsigned char> all(width, height);
    for (int y = 0; y < height; ++y)
        for (int v = std::max(0, y - kWithin); v <= std::min(height - 1, y + kWithin); ++v)
            for (int x = 0; x < width; ++x) all(x, y) |= beside(x, v);
    return all;
}

}  // namespace

SurfaceStructure::SurfaceStructure(const KnownSurfaces& known, const Mixtures& mixtures, Workers& workers) {
    if (mixtures.empty()) return;
    const int width = (mixtures.width() + kCell - 1) / kCell,
              height = (mixtures.height() + kCell - 1) / kCell;
    const Image<unsigned char> beside = cells_beside(mixtures, width, height, kCell);
    cells_ = Image<Changes>(width, height);
    across_ = Image<Direction>(width, height);
    parallel_for(height, workers, [&](int y) {
        for (int x = 0; x < width; ++x)
            if (beside(x, y)) cells_(x, y) = in_cell(known, x, y);
    });
    parallel_for(height, workers, [&](int y) {
        for (int x = 0; x < width; ++x)
            if (beside(x, y)) across_(x, y) = around(x, y);
    });
}

// Every second pixel of a row and of a column counts.
SurfaceStructure::Changes SurfaceStructure::in_cell(const KnownSurfaces& known, int cell_x, int cell_y) {
    const View<const float> radii = known.radii();
    const int left = kCell * cell_x, top = kCell * cell_y;
    const Rect cell = Rect{left, top, left + kCell, top + kCell}.intersected(radii.rect());
    Changes sum;
    const auto for_each_pixel = [&](const auto& visit) {
        for (int y = cell.y0; y < cell.y1; y += 2)
            for (int x = cell.x0; x < cell.x1; x += 2) visit(x, y);
    };
    for_each_pixel([&](int x, int y) { sum.coc_px = std::max(sum.coc_px, radii(x, y)); });
    for_each_pixel([&](int x, int y) {
        const auto shows = [&](int u, int v) { return known.shows(u, v, sum.coc_px); };
        if (!shows(x, y) || !shows(x - 1, y) || !shows(x + 1, y) || !shows(x, y - 1) || !shows(x, y + 1))
            return;
        const auto light = [&](int u, int v) { return comparable(known.colour(u, v)); };
        const Rgba dx = light(x + 1, y) - light(x - 1, y), dy = light(x, y + 1) - light(x, y - 1);
        const float xx = light2(dx), yy = light2(dy);
        sum.all += xx + yy;
        sum.axes += xx - yy;
        sum.diagonals += 2 * dot_light(dx, dy);
        sum.light += light2(light(x, y));
    });
    return sum;
}

Direction SurfaceStructure::around(int cell_x, int cell_y) const {
    const float coc_px = cells_(cell_x, cell_y).coc_px;
    const Rect near =
        Rect{cell_x - kAround, cell_y - kAround, cell_x + kAround + 1, cell_y + kAround + 1}.intersected(
            cells_.rect());
    Changes sum;
    for (int y = near.y0; y < near.y1; ++y)
        for (int x = near.x0; x < near.x1; ++x) {
            const Changes& c = cells_(x, y);
            if (!one_surface(c.coc_px, coc_px)) continue;
            sum.all += c.all;
            sum.axes += c.axes;
            sum.diagonals += c.diagonals;
            sum.light += c.light;
        }
    const float all = sum.all + completion_model.structure_least * sum.light + 1e-16f;
    return {sum.axes / all, sum.diagonals / all};
}

float SurfaceStructure::continues(KnownSurfaces::Place from, Direction doubled) const {
    const int x = from.x / kCell, y = from.y / kCell;
    if (!one_surface(cells_(x, y).coc_px, from.coc_px)) return 1;
    const Direction a = across_(x, y);
    // With the squared cosine of the angle between the two.
    const float coherence2 = a.x * a.x + a.y * a.y;
    const float across = 0.5f * (coherence2 + std::sqrt(coherence2) * (a.x * doubled.x + a.y * doubled.y));
    return 1 - completion_model.structure * across;
}

}  // namespace petzval::engine
