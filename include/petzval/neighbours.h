// Frames around each frame of a shot, for what its silhouettes hide. Component petzval::files.
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

// Of frames, ascending, those around one: up to `each_side` before it and as many after, the nearest first.
PETZVAL_API std::vector<int> frames_around(std::span<const int> frames, int frame, int each_side);

// Each is read once and kept while frames near it may follow: at most 2 * `each_side` + 1 pictures, with
// their depths 20 bytes a pixel, with motion vectors to both sides 36. Several threads may ask at once.
class PETZVAL_API Neighbours {
public:
    using Read = std::function<Result<Shot>(int frame)>;
    // frames: those of the shot that are there, ascending. max_memory_bytes: for what is kept, the frame
    // itself and the work on them; 0: no limit. Requires: each_side > 0.
    Neighbours(std::vector<int> frames, int each_side, Read read, std::size_t max_memory_bytes = 0);
    ~Neighbours();
    Neighbours(const Neighbours&) = delete;
    Neighbours& operator=(const Neighbours&) = delete;

    // What `eyes`, other views of that moment, see of what the shot hides, then what up to `each_side` frames
    // before and as many after do, the nearest in time first. A function of these alone. A neighbour that
    // cannot be read is left out by name. Errors: those of seen_elsewhere(); OutOfMemory.
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
};

}  // namespace petzval
