// What one picture hides and another of the same things shows: a frame before or after it, the other eye.
// Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"
#include "petzval/shot.h"
#include "petzval/workers.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace petzval {

struct SeenElsewhere {
    DeepPicture behind;  // of the shot's data window: at most one sample a pixel; empty if nothing was found
    std::size_t pixels = 0;
    std::vector<std::string> left_out;  // pictures that could not be used, and why; one line each
};

// Moves what each of `others` shows to where `shot` would see it, by both cameras (worldToCamera, focal
// length, sensor width) and depths, and keeps what lies there behind the shot's own surface; of several
// pictures the first that knows a pixel. Cameras may look along +z or -z and have x to either side: taken is
// how most of the picture fits.
//
// What moves by itself is found by its surface (pixels that touch and lie at one depth): where that is seen
// by both, at least nine in ten of its pixels have to lie at one depth, else all of it is left out. Pixels
// beside a nearer surface hold some of its light and are left out, and so is what is not opaque.
// Takes about 60 bytes a pixel beside the pictures. Errors: InvalidArgument without depth in metres, a
// camera or its matrix in `shot` itself.
PETZVAL_API Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const Shot* const> others,
                                                 Workers& workers);

// The same of views of one moment, as of two eyes, each from the others. Nothing is found for a view that has
// no depth in metres or no camera, that is deep or has hidden layers of its own.
PETZVAL_API std::vector<SeenElsewhere> seen_by_each_other(std::span<const Shot* const> views,
                                                          Workers& workers);

}  // namespace petzval
