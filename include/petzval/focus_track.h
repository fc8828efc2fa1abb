// A focus track from pixels of a shot. Component petzval::files.
#pragma once

#include "petzval/export.h"
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

// Distance of that object.
struct FocusKey {
    int frame = 0;
    double distance_m = 0;  // > 0, perhaps infinite
};

// The pixel moves linearly between two picks; it stays constant before the first and after the last.
// Requires: a pick, frames ascending.
PETZVAL_API PixelPosition pixel_at(std::span<const FocusPick> picks, int frame);

// Each key as the mean of all in dioptres, weighted by a Gaussian of this standard deviation in frames; 0
// leaves them. Frames without a key take no part.
PETZVAL_API std::vector<FocusKey> smoothed(std::span<const FocusKey> keys, double frames);

// Text for Track::read(): "frame,focus", a line per key.
PETZVAL_API std::string track_csv(std::span<const FocusKey> keys);

// A drawing (SVG): distance over frames, dioptres evenly, labelled in metres; what was measured as dots, the
// track as a line. Requires: keys.
PETZVAL_API std::string focus_plot(std::span<const FocusKey> measured, std::span<const FocusKey> track);

}  // namespace petzval
