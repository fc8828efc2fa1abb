// Motion vectors of renderers: the position of a pixel's surface in the frames before and
// after.
#pragma once

#include "petzval/image.h"

#include <string>

namespace petzval {

// In pixels of the picture per frame, +x right, +y down. NaN: not known.
struct PixelMove {
    float x = 0, y = 0;
};

// Vectors from a pixel to the place of its surface one frame before or after. If one direction is empty, the
// negative of the other replaces it, as for uniform motion.
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

// The choice of motion vectors in a file, and the meaning of their values.
struct MotionReading {
    // Without vectors, motion follows from cameras and depth (File), is assumed to be none (Still), or is
    // estimated from the pictures and their depths (Flow).
    enum class From { File, Still, Flow };
    From from = From::File;
    bool wanted = false;  // read vectors
    // A layer or part; empty: detected and reported. The names of the channels give their meaning, in
    // pixels, x right and y up. X, Y, Z, W are Blender's: the motion from here to the previous frame, and
    // the negative motion to the next (Cycles, kernel/geom/primitive.h: Z, W are the present position minus
    // the next). `forward` and `backward` with u, v are the motion to the next and to the previous frame
    // (Foundry's VectorGenerator; ILM's public frames agree). Two channels of any other layer are the
    // motion to the next frame (Arnold's motionvector, V-Ray's velocity).
    std::string layer = {};
    // Factors that turn the file's values into pixels per frame: 2 if the vectors span half a frame of
    // shutter, -1 if they point the other way, the picture's width in pixels if they are fractions of it.
    double scale_x = 1, scale_y = 1;
};

}  // namespace petzval
