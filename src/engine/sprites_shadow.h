// Which part of the lens a light is seen through: the part whose rays meet nothing nearer on their way.
//
// A light at s with radius c lands through the pupil point u at s + c u; on the way, where something has the
// radius c' < c, its ray passes s + (c - c') u (docs/conventions.md). Rays of a grid of pupil points are
// followed; between them the share is interpolated.
#pragma once

#include "engine/engine.h"

#include <array>
#include <cstdint>
#include <vector>

namespace petzval::engine {

// What is seen (1) and hidden (0) on a grid over the pupil's square, -1…1 on both axes, row by row. A bit
// for each point: there may be ten million lights.
struct PupilMask {
    static constexpr int kSide = 8;
    std::uint64_t seen = ~std::uint64_t(0);
    bool is_open() const { return seen == ~std::uint64_t(0); }
    bool is_closed() const { return seen == 0; }
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
    // Radii of what may stand in the way of a light, from `nearest` to `farthest`; none if it is clear.
    struct Blockers {
        float nearest = 1e30f, farthest = -1e30f;
        bool none() const { return nearest > farthest; }
    };
    Blockers blockers(float x, float y, float coc_px) const;
    bool is_stopped(float x, float y, float coc_px, float u, float v, const Blockers& blockers) const;

    const Input& in_;
    struct Block {
        float nearest = 1e30f, farthest = -1e30f;
    };
    Image<Block> blocks_;
};

}  // namespace petzval::engine
