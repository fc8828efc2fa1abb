// Hidden surfaces of one picture that another picture shows: the frame before or after it, or the other eye.
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
    // A pixel of the data window that shows a lamp but has another surface's depth.
    struct Lamp {
        int x = 0, y = 0;
        float depth_m = 0;  // of the lamp
    };
    std::vector<Lamp> lamps;            // by rows
    int by_motion = 0;                  // pictures that were moved by their motion vectors
    std::size_t kept_bytes = 0;         // by Neighbours: pictures for the frames that follow
    std::vector<std::string> left_out;  // one line for each picture, or its vectors, that could not be used
};

// Another picture of a shot's surfaces.
struct OtherPicture {
    const Shot* shot = nullptr;
    int frames_later = 0;  // later than the shot; 0: the same moment, such as the other eye
    // Without motion vectors, of another moment: Still, or estimated by optical flow (Flow).
    MotionReading::From motion_from = MotionReading::From::File;
};

// Projects the pixels of `others` into the view of `shot` and keeps those that lie behind the shot's own
// surface. If several pictures know a pixel, the first one is used.
//
// Without vectors, OtherPicture::motion_from decides: no motion, or estimated motion. The rules for
// ignoring a picture are those for vectors.
//
// With motion vectors, pixels of another moment follow them from frame to frame through the pictures between;
// where one of those hides the pixel, its motion continues uniformly. Otherwise both cameras (worldToCamera,
// focal length, sensor width) and depths project the pixels. Cameras may look along +z or -z and may have x
// to either side: the variant that fits most of the picture is used.
//
// A picture is ignored, with a line in `left_out`, in two cases:
//
//   by its camera    less than half of the picture looks the same: many objects move, and surfaces that were
//                    uncovered there may be covered now
//   by its vectors   less looks the same than by its camera, or, if the camera explains less than half, less
//                    than seven tenths
//
// Within a picture, surfaces (connected pixels at one depth) that move by themselves are ignored
// completely. Where both pictures see a surface, or one sees it slightly behind the other, at least nine in
// ten of its pixels must agree in depth and half of these in colour. With vectors, a surface may have come
// nearer or moved away as a whole. Also ignored are pixels beside a nearer surface, which contain some of
// its light; pixels that are not opaque; and surfaces behind objects narrower than three pixels, which the
// shot separates more steadily by the surfaces on both sides.
//
// Small lamps are kept. A lamp narrower than a pixel, or half behind an edge, may light a pixel that has
// another surface's depth in one frame and not in the next: the result has the lamp's depth there. If no
// pixel of the shot shows the lamp, it joins the hidden surfaces, with less light the more frames away it
// was seen, so it fades in before it appears.
//
// Memory: about 80 bytes a pixel beside the pictures. Errors: InvalidArgument if `shot` itself has no depth
// in metres, or, without vectors and motion_from, no camera or matrix.
PETZVAL_API Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const OtherPicture> others,
                                                 Workers& workers);
// The same for pictures of one moment.
PETZVAL_API Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const Shot* const> others,
                                                 Workers& workers);

// Stores the result in the shot: hidden layers, which replace the shot's own, and depths of lamps. Requires:
// `found` was made for this shot.
PETZVAL_API void take_over(SeenElsewhere found, Shot& shot);

// The views that may show what `of` hides: those that have a camera of their own and are not deep.
PETZVAL_API std::vector<const Shot*> other_eyes(std::span<const Shot* const> views, const Shot& of);
// Hidden surfaces of every view of one moment (two eyes), each from the other views. The result is empty for
// a view that has no depth in metres or no camera, is deep, or comes with hidden layers.
PETZVAL_API std::vector<SeenElsewhere> seen_by_each_other(std::span<const Shot* const> views,
                                                          Workers& workers);

}  // namespace petzval
