// Kernels for drawing very many lights: by radius, part of the display window and place within a pixel.
#pragma once

#include "device/kernels.h"
#include "engine/waist/engine.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace petzval::engine {

// One light. Unlike a given point it has no depth and no size any more.
struct Sprite {
    float x = 0, y = 0;  // pixels, centres at +0.5
    float coc_px = 0;
    float r = 0, g = 0, b = 0;
};

// Distinguishes kernels. Where the lens varies over the picture, the picture is divided into as many parts as
// kernels of these lights fit into memory.
class SpriteGrid {
public:
    SpriteGrid(const EngineView& input, std::span<const Sprite> sprites);
    // Divides the window into as many parts as the grid of all its lights does, so that a part of a frame is
    // drawn as in the whole.
    void take_parts_of(const SpriteGrid& whole) { columns_ = whole.columns_, rows_ = whole.rows_; }

    // The kernel of a light (0…count()-1), and the light's position.
    struct Place {
        std::size_t kernel = 0;
        int level = 0, x = 0, y = 0;  // cell of the kernel's level
    };
    Place place(float x, float y, float coc_px) const;  // in pixels, centres at +0.5
    std::size_t count() const;
    // level: by the radius; zone: the part of the window, step: the radius, piece: the place within a cell.
    device::KernelAsk ask(std::size_t kernel) const;
    static float radius_px(const device::KernelAsk& ask);  // signed
    // Pixels by which a light reaches, at most.
    float reach_px(int level, float coc_px) const;
    int phases() const { return phases_; }  // places within a cell, along each axis
    // The first phase, as a fraction of one: middles of pixels are among the phases, or lie half-way between
    // two where cells are wider.
    float first_phase(int level) const { return phases_ > 1 && level >= 2 ? 0.5f : 0.0f; }
    int columns() const { return columns_; }
    int rows() const { return rows_; }

private:
    void choose_parts(const EngineView& input, std::span<const Sprite> sprites, float largest_px);
    std::size_t bytes_for(const EngineView& input, std::span<const Sprite> sprites) const;
    int level_of(float radius_px) const;

    Rect frame_;
    float largest_cells_, pixels_per_radius_;
    int steps_ = 0, phases_ = 4, columns_ = 1, rows_ = 1;
    std::vector<int> reach_;  // in cells, by level
};

class SpriteKernels final : public device::KernelSource {
public:
    // light: for the light of a lamp, a name that distinguishes this lens from the picture's.
    SpriteKernels(const LensOnPicture& lens, const SpriteGrid& grid, const std::string& light = {});
    std::vector<Made> make(std::span<const device::KernelAsk> asks) const override;

private:
    const LensOnPicture lens_;  // of a picture that begins with the display window
    SpriteGrid grid_;
};

}  // namespace petzval::engine
