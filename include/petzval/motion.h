// Where what a pixel shows lies in the frames around: motion vectors, as renderers write them beside the
// colour.
#pragma once

#include "petzval/image.h"

#include <string>

namespace petzval {

// In pixels of the picture per frame, +x right, +y down. NaN: not known.
struct PixelMove {
    float x = 0, y = 0;
};

// From where a pixel's surface lies now to where it lies one frame before or after. Either may be empty: the
// other with its sign turned stands for it, as of what moves evenly.
struct MotionVectors {
    Image<PixelMove> to_previous, to_next;

    bool empty() const { return to_previous.empty() && to_next.empty(); }
    // Requires: not empty(), a pixel of the picture.
    PixelMove at(int x, int y, bool back) const {
        const Image<PixelMove>& own = back ? to_previous : to_next;
        if (!own.empty()) return own(x, y);
        const PixelMove other = (back ? to_next : to_previous)(x, y);
        return {-other.x, -other.y};
    }
};

// Which motion vectors to take from a file, and what they mean.
struct MotionReading {
    bool wanted = false;
    // A layer or part; empty: "detect, and say what was taken". By names of their channels, x to the right
    // and y upwards in pixels: X, Y, Z, W are Blender's, the way here from the next frame and to the previous
    // one (Cycles, kernel/geom/primitive.h: Z, W hold the present place less the next); `forward` and
    // `backward` with u, v are the ways to the next and to the previous frame (Foundry's VectorGenerator;
    // what of ILM's public frames moves fits it); two channels of any other layer the way to the next frame
    // (Arnold's motionvector, V-Ray's velocity: from the current to the next frame).
    std::string layer = {};
    // What the values are multiplied by: 2 where the shutter of vectors was open for half a frame, -1 where
    // they point the other way, the width in pixels where they are shares of it.
    double scale_x = 1, scale_y = 1;
};

}  // namespace petzval
