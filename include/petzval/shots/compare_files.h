// Compares a picture file with a reference, like petzval compare. Component petzval::files.
#pragma once

#include "petzval/compare.h"
#include "petzval/export.h"
#include "petzval/frame_loop.h"
#include "petzval/result.h"
#include "petzval/shot.h"

#include <functional>
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

// Calls only `say` and `cancelled` of `host`. Errors: those of read_shot(); InvalidArgument if sizes
// differ; OutputFailed; Cancelled.
PETZVAL_API Result<ComparedFiles> compare_files(const CompareFiles& files, const FrameLoopHost& host = {});

// Two shots frame by frame: paths of `files` may hold a frame number (frames.h). The work of a FrameLoop;
// `compared` is called after each frame that could be compared. Errors of frames: those above.
PETZVAL_API FrameWork work_of(const CompareFiles& files, const FrameLoopHost& host,
                              const std::function<void(int frame, const ComparedFiles&)>& compared);

}  // namespace petzval
