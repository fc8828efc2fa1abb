// Which part of the lens a light is seen through: the part whose rays meet nothing nearer on their way.
//
// A light at s with radius c lands through the pupil point u at s + c u; on the way, where something has the
// radius c' < c, its ray passes s + (c - c') u (docs/conventions.md). Rays of a grid of pupil points are
// followed; between them the share is interpolated.
#pragma once

#include "engine/engine.h"

#include <array>
#include <vector>

namespace petzval::engine {

// Shares on a grid over the pupil's square, -1…1 on both axes, row by row; empty: all is seen.
struct PupilMask {
    static constexpr int kSide = 8;
    std::vector<float> shares;
    bool is_open() const { return shares.empty(); }
    bool is_closed() const;
    // The shares along the row of the pupil at y (down, clamped to the grid), for at().
    std::array<float, kSide> row(float y) const;
    static float at(const std::array<float, kSide>& row, float x);
};

class SpriteShadows {
public:
    // input outlives this.
    explicit SpriteShadows(const Input& input);
    // (x, y) in pixels, centres at +0.5.
    PupilMask mask(float x, float y, float coc_px) const;

private:
    bool is_clear(float x, float y, float coc_px) const;
    bool is_stopped(float x, float y, float coc_px, float u, float v) const;

    const Input& in_;
    Plane nearest_;  // smallest radius in each block
};

}  // namespace petzval::engine
