// The possible occluders between a highlight and the lens, as few squares.
#pragma once

#include "petzval/workers.h"

#include "engine/waist/engine.h"
#include "laws/surfaces.h"

#include <array>
#include <atomic>
#include <span>
#include <vector>

namespace petzval::engine {

// A square of pixels that one surface covers at one radius.
struct Caster {
    float x = 0, y = 0;  // its middle, in pixels; the middle of pixel 0 is 0
    float size = 1;      // pixels on a side
    float coc_px = 0;    // in its middle
    float coverage = 1;
    float right_px = 0, down_px = 0;  // change of radius to the next pixel
};

// The samples of a picture by blocks of pixels. Opaque samples of nearly one radius are merged into squares
// of up to a block. What is far nearer than a highlight is seen small in its disc: for that there are coarser
// views of the same, whose squares are no smaller than 2 or 4 pixels and cover as much.
class ShadowCasters {
public:
    static constexpr int kBlock = 16;
    static constexpr int kViews = 3;  // view n: squares of 2^n pixels and more
    // The largest difference of radii in a merged square: its shadow moves by at most a fraction of a tap. A
    // light that is behind the square by less is not shadowed: the square may be its own surface.
    static constexpr float kSameRadiusPx = laws::kOneSquare.step_px;
    // Begins a picture of that size; its rows are added afterwards.
    ShadowCasters(int width, int height);
    ShadowCasters(const CocSamples& samples, Workers& workers);
    // The samples of the rows from y0 on, a multiple of kBlock, up to another or to the end; other rows may
    // be added at the same time.
    void add(int y0, const CocSamplesView& rows);

    int rows() const { return nearest_of_blocks_.height(); }  // of blocks
    float nearest_coc_px() const { return nearest_; }         // of all
    // Blocks are counted from the picture's corner.
    const Plane& nearest_of_blocks() const { return nearest_of_blocks_; }
    // Casters nearer than end_of_view(n) are the same in view n as in finer views, except for its resolution.
    std::span<const Caster> of_block(int view, int bx, int by) const;  // nearest first
    // The same for a row of blocks, one block after the other.
    std::span<const Caster> of_row(int view, int by) const {
        return views_[std::size_t(view)][std::size_t(by)].casters;
    }
    // The largest radius up to which a highlight of this radius loses nothing by view n.
    static float end_of_view(int view, float highlight_coc_px);

private:
    // A row of blocks, of the samples of these rows of pixels.
    void add_blocks(int by, const CocSamplesView& samples, const Rect& rows);

    Plane nearest_of_blocks_;
    std::atomic<float> nearest_{1e30f};
    struct RowOfBlocks {
        std::vector<Caster> casters;
        std::vector<std::size_t> first;  // of each block, and the end
    };
    std::array<std::vector<RowOfBlocks>, kViews> views_;
};

}  // namespace petzval::engine
