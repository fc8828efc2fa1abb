// Compares a picture file with a reference, like petzval compare. Component petzval::files.
#pragma once

#include "petzval/compare.h"
#include "petzval/export.h"
#include "petzval/frame_loop.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace petzval {

struct CompareFiles {
    ShotSource reference;  // its layer and view apply to both; depth is not read
    std::string test;      // a picture whose display window has the same size
    std::string mask =
        {};  // a PNG's first channel as stored, or the luminance of another picture, of that size
    std::string heat_map = {};  // .png: heat_map() of the difference; empty: none
    double exposure = 1;        // as CompareSettings has it
    bool overwrite = true;      // false: an existing heat map is an error
};

struct ComparedFiles {
    Comparison comparison;  // over the display window, which is black outside the data window
    std::vector<WorstPlace> worst;
    std::string record;  // JSON (records.h)
};
// The result for people: the measures as a table, then a line for each of the worst places.
PETZVAL_API std::string comparison_text(const ComparedFiles& compared);

// Calls only `say` and `cancelled` of `host`. Errors: those of read_shot(); InvalidArgument if sizes
// differ; OutputFailed; Cancelled.
PETZVAL_API Result<ComparedFiles> compare_files(const CompareFiles& files, const FrameLoopHost& host = {});

// Two shots frame by frame: paths of `files` may hold a frame number (frames.h). The work of a FrameLoop;
// `compared` is called after each frame that could be compared. Errors of frames: those above.
PETZVAL_API FrameWork work_of(const CompareFiles& files, const FrameLoopHost& host,
                              const std::function<void(int frame, const ComparedFiles&)>& compared);

// The comparisons of a shot, collected frame by frame.
class PETZVAL_API ComparedShot {
public:
    void add(int frame, const ComparedFiles& compared);
    // The frame with the lowest psnr_lin, of several the first; empty without frames.
    std::optional<int> worst_frame() const;
    // A row for each frame, the mean of the measures that have one, and the worst frame with its worst
    // places; empty without frames.
    std::string text() const;

private:
    std::string rows_, places_;
    Comparison sum_, worst_;
    int count_ = 0, worst_frame_ = 0;
};

}  // namespace petzval
