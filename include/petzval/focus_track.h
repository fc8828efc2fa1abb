// A focus track from pixels of a shot. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/frame_loop.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <span>
#include <string>
#include <vector>

namespace petzval {

// Position in a frame of the object to keep sharp.
struct FocusPick {
    int frame = 0;
    PixelPosition pixel;
};

// The picks by frame, in the order that pixel_at() needs. Errors: InvalidArgument if two have the same frame.
PETZVAL_API Result<std::vector<FocusPick>> in_order(std::vector<FocusPick> picks);

// Distance of that object.
struct FocusKey {
    int frame = 0;
    double distance_m = 0;  // > 0, perhaps infinite
};

// The pixel moves linearly between two picks; it stays constant before the first and after the last.
// Requires: a pick, frames ascending.
PETZVAL_API PixelPosition pixel_at(std::span<const FocusPick> picks, int frame);

// Replaces each key by the mean of all in dioptres, weighted by a Gaussian of this standard deviation in
// frames; 0 changes nothing. Frames without a key do not count.
PETZVAL_API std::vector<FocusKey> smoothed(std::span<const FocusKey> keys, double frames);

// Text for Track::read(): "frame,focus", a line per key.
PETZVAL_API std::string track_csv(std::span<const FocusKey> keys);

// A drawing (SVG) of distance over frames on a dioptre scale with labels in metres: measurements as dots,
// the track as a line. Requires: keys.
PETZVAL_API std::string focus_plot(std::span<const FocusKey> measured, std::span<const FocusKey> track);

// A track that is measured at picks in a few frames of a shot.
struct FocusTracking {
    ShotSource source;             // its path or that of its depth holds a frame number (frames.h)
    std::vector<FocusPick> picks;  // at least one, frames ascending
    int within_px = 2;             // the median depth of the pixels within this many columns and rows is used
    double smooth_frames = 2;      // as smoothed() takes it
    std::string output;            // the track, CSV
    std::string plot = {};         // focus_plot(); empty: none
    bool overwrite = true;         // false: an existing file is an error
};
// The work of a FrameLoop. The files are written once all frames are done; frames without a surface at the
// pick have no key, and a warning in their record. Of `host`, only `say` and `cancelled` are called. Errors
// of frames: those of read_shot() and distance_around_m(); of the files: InvalidFile if no frame has a
// surface there; OutputFailed.
PETZVAL_API FrameWork work_of(FocusTracking settings, FrameLoopHost host = {});

}  // namespace petzval
