// The final-frame engine: split, spread by levels, composite by lens area (docs/design/scatter.md).
#include "base/parallel.h"
#include "engine/complete.h"
#include "engine/engine.h"
#include "engine/highlights.h"
#include "engine/lens_ray.h"
#include "engine/sources.h"
#include "engine/spread.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace petzval::engine {
namespace {

constexpr int kTile = 64;

// One tile of the picture: what has arrived so far, and how much of the lens is still free.
class TileComposite {
public:
    explicit TileComposite(const Rect& area)
        : area_(area), sum_(area.width(), area.height()), free_(area.width(), area.height(), 1.0f) {}

    // The lens-area budget: a layer takes the area it arrives with, or what is left of the lens if that is
    // less.
    void add(View<const Rgba> layer) {
        for (int y = 0; y < area_.height(); ++y)
            for (int x = 0; x < area_.width(); ++x) {
                const Rgba c = layer(x, y);
                if (c.a <= 0) continue;
                const float taken = std::min(c.a, free_(x, y));
                sum_(x, y) += c * (taken / c.a);
                free_(x, y) -= taken;
            }
    }

    // What no source reached is spread over those that did: discrete sources leave a little of the lens free.
    void finish(View<Rgba> out) {
        for (int y = 0; y < area_.height(); ++y)
            for (int x = 0; x < area_.width(); ++x) {
                Rgba c = sum_(x, y);
                if (c.a > 0) c *= 1 / c.a;
                out(area_.x0 + x, area_.y0 + y) = c;
            }
    }

private:
    Rect area_;
    Picture sum_;
    Plane free_;
};

}  // namespace

Result<Output> run_scatter(const Input& input) {
    const auto start = std::chrono::steady_clock::now();
    const auto seconds = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    const float largest_cells = 12;

    Input complete = input;
    complete.deep = completed(input);
    const double completed_at = seconds();
    const SplitInput split = split_highlights(complete, HighlightSplit(input.colour, 2, 0.5f, input.threads));
    complete.colour = split.base;
    complete.deep = split.deep;
    const double split_at = seconds();
    const SourceGrid grid = SourceGrid::make(complete, largest_cells);
    const double sources_at = seconds();
    const SpreadTable table(*input.lens, largest_cells * 1.2f);

    Output output;
    output.image = Picture(input.width(), input.height());
    const int tiles_x = (input.width() + kTile - 1) / kTile, tiles_y = (input.height() + kTile - 1) / kTile;
    parallel_for(tiles_x * tiles_y, input.threads, [&](int i) {
        if (input.progress->cancelled()) return;
        const int tx = i % tiles_x * kTile, ty = i / tiles_x * kTile;
        const Rect area = Rect{tx, ty, tx + kTile, ty + kTile}.intersected(output.image.rect());
        TileComposite tile(area);
        for (const Picture& layer : spread_layers(grid, table, area)) tile.add(layer);
        tile.finish(output.image);
        input.progress->advance(0.9 / (tiles_x * tiles_y));
    });
    const double spread_at = seconds();

    // Highlights
    {
        const Surfaces surfaces = Surfaces::make(complete, 1);
        for (const Highlight& h : split.highlights) {
            const kernel::PointSpread spread =
                visible_point_spread(surfaces, *input.lens, input.field_at(h.x, h.y), h.x, h.y, h.coc_px);
            const Rect e = spread.extent;
            const Rect place =
                Rect{h.x + e.x0, h.y + e.y0, h.x + e.x1, h.y + e.y1}.intersected(output.image.rect());
            for (int y = place.y0; y < place.y1; ++y)
                for (int x = place.x0; x < place.x1; ++x)
                    output.image(x, y) += spread.weights(x - h.x - e.x0, y - h.y - e.y0) * h.colour;
        }
    }
    if (input.progress->cancelled()) return Error{ErrorCode::Cancelled, "cancelled"};
    output.stages = {{"complete", completed_at},
                     {"split", split_at - completed_at},
                     {"sources", sources_at - split_at},
                     {"spread", spread_at - sources_at},
                     {"highlights", seconds() - spread_at}};
    return output;
}

}  // namespace petzval::engine
