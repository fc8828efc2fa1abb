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
    // A pixel of the data window that shows the light of a lamp, and has the depth of something else.
    struct Lamp {
        int x = 0, y = 0;
        float depth_m = 0;  // of the lamp
    };
    std::vector<Lamp> lamps;            // by rows
    int by_motion = 0;                  // pictures that were moved by their motion vectors
    std::size_t kept_bytes = 0;         // by Neighbours: pictures for the frames that follow
    std::vector<std::string> left_out;  // pictures, or their vectors, that could not be used; a line each
};

// Another picture of a shot's surfaces.
struct OtherPicture {
    const Shot* shot = nullptr;
    int frames_later = 0;  // than the shot; 0: of the same moment, as the other eye
};

// Moves what each of `others` shows to where `shot` would see it and keeps what lies there behind the shot's
// own surface; of several pictures the first that knows a pixel. Of another moment, and with motion vectors:
// by these, from frame to frame through those of `others` that lie between, evenly on where one of them hides
// it. Else by both cameras (worldToCamera, focal length, sensor width) and depths; these may look along +z or
// -z and have x to either side: taken is how most of the picture fits.
//
// Left out with a line that says so: a picture of which by its camera less than half looks the same (much
// moves by itself then, and what was uncovered in it may be covered now), and vectors by which less looks the
// same than by the camera, or, where that does not hold half of it, less than seven tenths. Of the others,
// what moves otherwise is found by its surface (pixels that touch and lie at one depth): where both see it,
// or one sees it a little behind the other, at least nine in ten of its pixels have to lie at one depth and
// half of these to look the same, else all of it is left out. With vectors it may have come nearer or gone
// away as a whole. Pixels beside a nearer surface hold some of its light and are left out, and so is what is
// not opaque, and what lies behind things narrower than three pixels: those are taken apart by what shows on
// both of their sides, and are steadier so. But small lamps: where one lights a pixel of the shot that has
// the depth of something else, as those narrower than a pixel and those half behind an edge do in one frame
// and not in the next, its depth is told; where nothing shows it, it is among what is behind, with less of
// its light the more frames later or earlier it was seen: it fades in before it comes out. Takes about 80
// bytes a pixel beside the pictures. Errors: InvalidArgument without depth in metres in `shot` itself, and
// without a camera or its matrix where there are no vectors.
PETZVAL_API Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const OtherPicture> others,
                                                 Workers& workers);
// The same of one moment.
PETZVAL_API Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const Shot* const> others,
                                                 Workers& workers);

// Puts into the shot what was found: hidden layers in place of its own, depths of lamps. Requires: found for
// it.
PETZVAL_API void take_over(SeenElsewhere found, Shot& shot);

// Those of `views` that may show what one of them hides: they have a camera of their own, and are not deep.
PETZVAL_API std::vector<const Shot*> other_eyes(std::span<const Shot* const> views, const Shot& of);
// The same of views of one moment, as of two eyes, each from the others. Nothing is found for a view that has
// no depth in metres or no camera, that is deep or has hidden layers of its own.
PETZVAL_API std::vector<SeenElsewhere> seen_by_each_other(std::span<const Shot* const> views,
                                                          Workers& workers);

}  // namespace petzval
