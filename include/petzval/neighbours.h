// Neighbouring frames of a shot, which show surfaces that its silhouettes hide. Component petzval::files.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"
#include "petzval/seen_elsewhere.h"
#include "petzval/shot.h"
#include "petzval/workers.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace petzval {

// The neighbours of one frame: up to `each_side` frames before it and as many after it, the nearest first.
// `frames` is ascending.
PETZVAL_API std::vector<int> frames_around(std::span<const int> frames, int frame, int each_side);

// Reads each frame once and keeps it while nearby frames may need it: at most 2 * `each_side` + 1 pictures
// of 20 bytes per pixel with depth, or 36 with motion vectors in both directions. Several threads may use
// it at once.
class PETZVAL_API Neighbours {
public:
    using Read = std::function<Result<Shot>(int frame)>;
    // frames: the frames of the shot that exist, ascending. max_memory_bytes: limit for kept pictures, the
    // frame itself and the work on both; 0: no limit. Requires: each_side > 0. from: the motion of surfaces
    // if frames have no motion vectors.
    Neighbours(std::vector<int> frames, int each_side, Read read, std::size_t max_memory_bytes = 0,
               MotionReading::From from = MotionReading::From::File);
    ~Neighbours();
    Neighbours(const Neighbours&) = delete;
    Neighbours& operator=(const Neighbours&) = delete;

    // Finds surfaces that `shot` hides: first in `eyes` (other views of the same moment), then in up to
    // `each_side` frames before and after, the nearest in time first. The result depends on these pictures
    // alone. A neighbour that cannot be read is skipped, and a warning names it. Errors: those of
    // seen_elsewhere(); OutOfMemory.
    Result<SeenElsewhere> behind(const Shot& shot, int frame, Workers& workers,
                                 std::span<const Shot* const> eyes = {});

private:
    Status check_memory(const Shot& shot) const;
    struct Kept;
    std::unique_ptr<Kept> kept_;
    std::vector<int> frames_;
    int each_side_;
    Read read_;
    std::size_t max_memory_bytes_;
    MotionReading::From from_;
};

}  // namespace petzval
