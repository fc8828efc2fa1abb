// Converts scene-linear pictures to display pictures, like petzval develop: glare, exposure, tone curve,
// one PNG per frame. Component petzval::files.
#pragma once

#include "petzval/display_files.h"
#include "petzval/export.h"
#include "petzval/frame_loop.h"
#include "petzval/lens.h"
#include "petzval/look.h"
#include "petzval/made_with.h"
#include "petzval/result.h"
#include "petzval/shot.h"
#include "petzval/shot_run.h"

#include <optional>
#include <string>

namespace petzval {

struct DevelopShot {
    ShotSource source;  // depth is not read
    Look look = {};     // its glare, and the lens that glare needs
    DisplayChoice display = {};
    std::optional<Transfer> transfer = {};  // as the user gave it
    bool dither = true;
    // Names of the display view and space that ShotRunHost::to_display shows, as in ShotRunSettings.
    std::string display_view = {}, display_space = {};
    std::string output;  // .png
    ExistingOutputs existing = ExistingOutputs::Replace;
    int threads = 0;  // 0: all
};

// Refuses an output in another format than PNG; check_display() is included. Errors: InvalidArgument.
PETZVAL_API Status check(const DevelopShot& settings);

// One picture: paths hold no frame number. `lens` is that of the look. The record is that of `petzval develop
// --json`. Of `host`, only `say`, `cancelled` and `to_display` are called. Errors: those of check(),
// read_shot(), of Session::add_light() and of to_display; OutputFailed.
PETZVAL_API Result<FrameRecord> develop_picture(const DevelopShot& settings, const Lens& lens,
                                                const ShotRunHost& host = {});

// All frames of a shot: the paths of source and output hold a frame number (frames.h). The work of a
// FrameLoop. Errors of frames: those above.
PETZVAL_API FrameWork work_of(const DevelopShot& settings, const Lens& lens, const ShotRunHost& host = {});

}  // namespace petzval
