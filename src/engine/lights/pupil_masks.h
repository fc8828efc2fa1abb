// The part of the lens through which a light is seen: the part whose rays meet no nearer surface on their
// way.
//
// A light at s with radius c lands through the pupil point u at s + c u. Where a surface on the way has the
// radius c' < c, the ray passes s + (c - c') u (docs/conventions.md). So a surface at q with radius c' hides
// the pupil point u = (q - s) / (c - c'), and a square of pixels at almost the same radius hides a square of
// the pupil. A quad-tree of the picture's radii finds these squares, large ones first.
#pragma once

#include "engine/lights/plan.h"
#include "engine/waist/engine.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace petzval::engine {

class PupilMasks {
public:
    // input outlives this. Of given samples, the second surface of each pixel hides lights too: a hair before
    // a floor makes no hole in the floor.
    explicit PupilMasks(const EngineView& input);
    // (x, y) in pixels, centres at +0.5.
    PupilMask mask(float x, float y, float coc_px) const;

private:
    // Radii in a square of 2^level pixels.
    struct Node {
        float nearest = 1e30f, farthest = -1e30f;
        bool is_whole = true;  // one surface without a jump
        std::uint64_t bins =
            0;  // which of 64 equal steps from the picture's nearest to its farthest there are
        void include(const Node& other);
    };
    PupilMasks(const EngineView& input, View<const float> coc_px);

    int bin(float coc_px) const;
    Node pixel(int x, int y) const;
    Node node(int level, int x, int y) const {
        return level == 0 ? pixel(x, y) : levels_[std::size_t(level - 1)](x, y);
    }
    int top() const { return int(levels_.size()); }

    struct Light {
        float x, y, coc_px;
    };
    struct Square;
    // Pupil points behind a square, of which `all` may be hidden by it and `surely` are.
    struct Behind {
        std::uint64_t all = 0, surely = 0;
    };
    Behind behind(const Light& light, int level, int x, int y, const Node& node) const;
    // Takes what the surfaces hide from `seen`.
    void hide_all(const Light& light, std::uint64_t& seen) const;
    // Takes what a square, or those of a level in a range (ends included, 2 x 2 at most), hides from `seen`.
    void hide(const Light& light, int level, int x, int y, std::uint64_t& seen) const;
    void hide_four(const Light& light, int level, const Rect& squares, std::uint64_t& seen) const;

    const EngineView& in_;
    View<const float> coc_px_;
    Plane second_px_;                           // of second surfaces; empty: there are none
    std::unique_ptr<const PupilMasks> second_;  // their masks
    float bins_per_px_ = 0;
    std::vector<Image<Node>> levels_;  // [0]: squares of 2 pixels
};

}  // namespace petzval::engine
