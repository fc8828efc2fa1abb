#pragma once

#include "petzval/image.h"

#include <cstdint>
#include <functional>

namespace petzval::engine {

// The light that lamps add to a picture's pixels (engine/lights: HighlightSplit::dim).
struct Dim {
    // Light of pixel (x, y) without the light of lamps. Empty if the picture has no lamps.
    std::function<Rgba(int x, int y, Rgba light)> of;
    // Light of luminance up to least * its coverage is unchanged: a quick test that most pixels pass.
    float least = 0;
    float white = 0;         // scene-linear luminance from which light counts as bright; 0: no light does
    std::uint64_t name = 0;  // functions that differ in more than the two numbers have different names

    explicit operator bool() const { return bool(of); }
    Rgba operator()(int x, int y, Rgba light) const {
        return luminance(light) <= least * light.a ? light : of(x, y, light);
    }
};

}  // namespace petzval::engine
