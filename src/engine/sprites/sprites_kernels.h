// Kernels for drawing lights: by radius, part of the display window and place within a pixel, made when first
// asked for.
#pragma once

#include "device/cpu/stamp.h"
#include "engine/sprites/sprites_draw.h"
#include "engine/waist/engine.h"

#include <atomic>
#include <memory>
#include <span>
#include <vector>

namespace petzval::engine {

// Which kernel a light is drawn with, and where it goes: cells are 2^level pixels wide.
struct Stamping {
    int kernel = 0;
    int level = 0;
    int x = 0, y = 0;  // cell
};

class SpriteKernels {
public:
    // For these lights. input outlives this.
    SpriteKernels(const Input& input, std::span<const Sprite> sprites);
    ~SpriteKernels();
    SpriteKernels(const SpriteKernels&) = delete;
    SpriteKernels& operator=(const SpriteKernels&) = delete;

    int levels() const { return levels_; }
    // Cells by which a kernel of a level reaches.
    int reach(int level) const { return reach_[std::size_t(level)]; }
    // (x, y) in pixels, centres at +0.5.
    Stamping stamping(float x, float y, float coc_px) const;
    // Of a kernel, signed.
    float radius_px(int kernel) const {
        const int radius = kernel / (phases_ * phases_);
        return (radius / steps_ % 2 ? 1.0f : -1.0f) * radius_of(radius % steps_);
    }
    // The lens's kernel; lights of one number share it. Thread-safe.
    const StampKernel& at(int kernel) const;

private:
    void choose_parts(std::span<const Sprite> sprites, float largest_px);
    std::size_t bytes_for(std::span<const Sprite> sprites) const;
    std::size_t count() const;
    kernel::PointSpread spread(int kernel) const;
    static int step_of(float radius_px);
    static float radius_of(int step);
    int level_of(float radius_px) const;

    const Input& input_;
    int steps_ = 0, levels_ = 1, phases_ = 4, parts_x_ = 1, parts_y_ = 1;
    float largest_cells_;
    std::vector<int> reach_;
    mutable std::vector<std::atomic<const StampKernel*>> kernels_;
};

}  // namespace petzval::engine
